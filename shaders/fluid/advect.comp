#version 460
#include "numerics/layout.h"
#include "fluid/layout.h"
#include "fluid/grid.glsl"
#include "numerics/tiles.glsl"
#include "fluid/points.glsl"
#include "fluid/trace.glsl"

// Carries the velocity along: each face takes the value from where its fluid came. One thread a face.
// Source: notes 10.4; Stam 1999; Selle, Fedkiw, Kim, Liu & Rossignac 2008 (MacCormack).
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { FluidArgs args; };

const uint semi_lagrangian = 0u;
/// other holds the field carried forth by semi_lagrangian: it is carried back and half of what is missing
/// then is given to it, within the values around the place it came from.
const uint correct = 1u;
const uint keep = 2u;  ///< result = velocity

void main() {
  FluidScene scene = args.scene.at[0];
  const float step = args.clock.at[0].step;
  ivec3 at;
  if (!point_of_thread(scene, args.axis, at) || step == 0.0) return;
  const uint index = point_index(points_of(scene.cells, args.axis), at);
  const float here = read_face(args.velocity, args.axis, index);
  if (args.mode == keep || in_closed_wall(scene, args.axis, at)) {
    write_face(args.result, args.axis, index, args.mode == keep ? here : 0.0);
    return;
  }
  const vec3 place = place_of(args.axis, at);
  const float cells_per_speed = step / scene.spacing;
  const vec3 source = trace_back(scene, args.velocity, place, cells_per_speed);
  const Sampled there = sample_field(scene, args.velocity, args.field, args.axis, source);
  float value = there.value;
  if (args.mode == correct) {
    const vec3 target = trace_back(scene, args.velocity, place, -cells_per_speed);
    const float back = sample_field(scene, args.other, args.field, args.axis, target).value;
    precise float better = value + 0.5 * (here - back);
    value = clamp(better, there.low, there.high);
  }
  write_face(args.result, args.axis, index, value);
}
