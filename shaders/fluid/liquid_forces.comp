#version 460
#include "numerics/layout.h"
#include "fluid/layout.h"
#include "fluid/grid.glsl"
#include "numerics/tiles.glsl"
#include "fluid/points.glsl"

// Gravity; one thread a face. Source: notes 10.4.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { LiquidArgs args; };

void main() {
  const float step = args.clock.at[0].step;
  if (step == 0.0) return;
  FluidScene scene = args.scene.at[0];
  ivec3 face;
  if (!point_of_thread(scene, args.axis, face)) return;
  const uint index = point_index(points_of(scene.cells, args.axis), face);
  write_face(args.velocity, args.axis, index,
             read_face(args.velocity, args.axis, index) + step * scene.force[args.axis]);
}
