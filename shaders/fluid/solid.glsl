// Distance and velocity of solids. Source: Batty, Bertails & Bridson 2007; sim/fluid.h.

float box_distance(vec3 from_center, vec3 half_sides) {
  const vec3 q = abs(from_center) - half_sides;
  return length(max(q, 0.0)) + min(max(max(q.x, q.y), q.z), 0.0);
}

/// Distance to the nearest solid, and its velocity; 3e38 without solids.
vec4 nearest_solid(FluidScene scene, float time, vec3 position) {
  vec4 nearest = vec4(0.0, 0.0, 0.0, 3e38);
  for (uint k = 0u; k < scene.solid_count; ++k) {
    const FluidSolidRecord solid = scene.solids.at[k];
    const vec3 p = position - (solid.center + time * solid.velocity);
    const float d = solid.shape == 0u ? length(p) - solid.half_sides.x : box_distance(p, solid.half_sides);
    if (d < nearest.w) nearest = vec4(solid.velocity, d);
  }
  return nearest;
}
