// The rate of change of velocity on a staggered grid, by differences of the flux of momentum. Needs
// fluid/grid.glsl. Source: notes 10.4; Harlow & Welch 1965; row 169 for the limits.

/// The velocity at a face that may lie one beyond the domain: mirrored at walls that the fluid clings
/// to, copied at others, from the other end of a periodic axis.
float beyond(FluidScene scene, FluidFaces u, uint axis, ivec3 at) {
  float sign = 1.0, offset = 0.0;
  for (uint d = 0u; d < 3u; ++d) {
    const int last = int(scene.cells[d]) - (d == axis ? 0 : 1);
    if (at[d] >= 0 && at[d] <= last) continue;
    const uint side = 2u * d + (at[d] < 0 ? 0u : 1u);
    if (scene.walls[side] == wall_periodic) {
      at[d] += (at[d] < 0 ? 1 : -1) * int(scene.cells[d]);
      continue;
    }
    at[d] = at[d] < 0 ? 0 : last;
    if (scene.walls[side] == wall_no_slip && d != axis) {
      sign = -sign;
      offset = 2.0 * scene.wall_velocities[side][axis] - offset;
    }
  }
  return sign * read_face(u, axis, point_index(points_of(scene.cells, axis), at)) + offset;
}

/// What a flux carries between a value before and one behind.
float carried(uint method, float flow, float before, float behind) {
  if (method == fluid_upwind) return flow > 0.0 ? before : behind;
  return 0.5 * (before + behind);
}

/// Divergence of the flux of momentum, with the sign of a rate, m/s^2.
float advection_rate(FluidScene scene, FluidFaces u, uint axis, ivec3 at) {
  const float here = beyond(scene, u, axis, at);
  precise float rate = 0.0;
  for (uint d = 0u; d < 3u; ++d) {
    if (scene.cells[d] == 1u && !wraps(scene, d)) continue;
    const ivec3 step = unit(d);
    const float before = beyond(scene, u, axis, at - step);
    const float behind = beyond(scene, u, axis, at + step);
    float flow_in, flow_out;
    if (d == axis) {
      flow_in = 0.5 * (before + here);
      flow_out = 0.5 * (here + behind);
    } else {
      const ivec3 back = at - unit(axis);
      flow_in = 0.5 * (beyond(scene, u, d, back) + beyond(scene, u, d, at));
      flow_out = 0.5 * (beyond(scene, u, d, back + step) + beyond(scene, u, d, at + step));
    }
    rate -= (flow_out * carried(scene.method, flow_out, here, behind) -
             flow_in * carried(scene.method, flow_in, before, here)) / scene.spacing;
  }
  return rate;
}

/// Sum of the second differences times the square of the spacing.
float second_differences(FluidScene scene, FluidFaces u, uint axis, ivec3 at) {
  const float here = beyond(scene, u, axis, at);
  precise float sum = 0.0;
  for (uint d = 0u; d < 3u; ++d) {
    if (scene.cells[d] == 1u && !wraps(scene, d)) continue;
    sum += (beyond(scene, u, axis, at + unit(d)) - here) - (here - beyond(scene, u, axis, at - unit(d)));
  }
  return sum;
}
