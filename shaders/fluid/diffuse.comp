#version 460
#include "numerics/layout.h"
#include "fluid/layout.h"
#include "fluid/grid.glsl"
#include "numerics/tiles.glsl"
#include "fluid/points.glsl"
#include "fluid/momentum.glsl"

// Viscosity: one explicit step, or a red-black sweep of the implicit one; one thread a face. Source:
// notes 10.4; row 169.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { FluidArgs args; };

const uint explicit_step = 2u;  ///< result = velocity + ...; below: the colour of an implicit sweep
                                ///< over result = velocity with the right side `other`

/// Sides beside a face where a mirrored value adds to the diagonal.
float mirrors(FluidScene scene, ivec3 at) {
  float count = 0.0;
  for (uint d = 0u; d < 3u; ++d) {
    if (d == args.axis) continue;
    if (at[d] == 0 && scene.walls[2u * d] == wall_no_slip) count += 1.0;
    if (at[d] == int(scene.cells[d]) - 1 && scene.walls[2u * d + 1u] == wall_no_slip) count += 1.0;
  }
  return count;
}

void main() {
  const float step = args.clock.at[0].step;
  if (step == 0.0) return;
  FluidScene scene = args.scene.at[0];
  ivec3 at;
  if (!point_of_thread(scene, args.axis, at)) return;
  const uint index = point_index(points_of(scene.cells, args.axis), at);
  if (in_closed_wall(scene, args.axis, at)) {
    write_face(args.result, args.axis, index, 0.0);
    return;
  }
  const float alpha = scene.viscosity * step / (scene.spacing * scene.spacing);
  const float here = read_face(args.velocity, args.axis, index);
  if (args.mode == explicit_step) {
    precise float value = here + alpha * second_differences(scene, args.velocity, args.axis, at);
    write_face(args.result, args.axis, index, value);
    return;
  }
  if (uint(at.x + at.y + at.z) % 2u != args.mode) return;
  float links = 0.0;
  for (uint d = 0u; d < 3u; ++d) links += scene.cells[d] > 1u ? 2.0 : 0.0;
  const float residual = read_face(args.other, args.axis, index) - here +
                         alpha * second_differences(scene, args.velocity, args.axis, at);
  write_face(args.result, args.axis, index,
             here + residual / (1.0 + alpha * (links + mirrors(scene, at))));
}
