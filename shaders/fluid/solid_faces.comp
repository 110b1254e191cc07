#version 460
#include "numerics/layout.h"
#include "fluid/layout.h"
#include "fluid/grid.glsl"
#include "numerics/tiles.glsl"
#include "fluid/points.glsl"
#include "fluid/solid.glsl"

// How open each face of an axis is at the end of the step and how fast what closes it moves; one
// thread a face. Source:
// sim/fluid.h, open_fractions.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { FluidCellArgs args; };

void main() {
  FluidScene scene = args.scene.at[0];
  ivec3 face;
  if (!point_of_thread(scene, args.axis, face)) return;
  const uint index = point_index(points_of(scene.cells, args.axis), face);
  float open = 0.0, speed = 0.0;
  if (!in_closed_wall(scene, args.axis, face)) {
    const float time = args.clock.at[0].time + args.clock.at[0].step;
    const ivec3 a = unit((args.axis + 1u) % 3u), b = unit((args.axis + 2u) % 3u);
    float outside = 0.0, all = 0.0;
    for (int k = 0; k < 4; ++k) {
      const vec3 corner = vec3(face + (k & 1) * a + (k >> 1) * b);
      const float d = nearest_solid(scene, time, scene.origin + scene.spacing * corner).w;
      outside += max(d, 0.0);
      all += abs(d);
    }
    open = scene.solid_count == 0u ? 1.0 : (all > 0.0 ? floor(31.0 * (outside / all) + 0.5) / 31.0 : 0.0);
    const vec3 middle = vec3(face) + 0.5 * vec3(a + b);
    if (scene.solid_count > 0u)
      speed = nearest_solid(scene, time, scene.origin + scene.spacing * middle)[args.axis];
  }
  write_face(args.open, args.axis, index, open);
  write_face(args.boundary, args.axis, index, speed);
}
