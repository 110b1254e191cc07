#version 460
#include "numerics/layout.h"
#include "fluid/layout.h"
#include "fluid/grid.glsl"
#include "numerics/tiles.glsl"
#include "fluid/points.glsl"
#include "fluid/trace.glsl"

// Carries smoke and temperature along, which come from the same place; one thread a cell. Source: notes
// 10.4; Stam 1999; Selle, Fedkiw, Kim, Liu & Rossignac 2008 (MacCormack).
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { FluidCarryArgs args; };

const uint semi_lagrangian = 0u;
const uint correct = 1u;  ///< what semi_lagrangian carried forth, with half of what is missing carried back

Sampled sample_cells(FluidScene scene, ref_float field, vec3 place) {
  return sample_field(scene, args.velocity, field, 3u, place);
}

/// The corrected value, within those around the place that it came from.
float corrected(Sampled there, float original, float back) {
  precise float better = there.value + 0.5 * (original - back);
  return clamp(better, there.low, there.high);
}

void main() {
  FluidScene scene = args.scene.at[0];
  const float step = args.clock.at[0].step;
  ivec3 at;
  if (!point_of_thread(scene, 3u, at) || step == 0.0) return;
  const uint index = point_index(ivec3(scene.cells), at);
  const vec3 place = place_of(3u, at);
  const float cells_per_speed = step / scene.spacing;
  const vec3 source = trace_back(scene, args.velocity, place, cells_per_speed);
  const Sampled smoke = sample_cells(scene, args.smoke, source);
  const Sampled temperature = sample_cells(scene, args.temperature, source);
  if (args.mode == semi_lagrangian) {
    args.smoke_forth.at[index] = smoke.value;
    args.temperature_forth.at[index] = temperature.value;
    return;
  }
  const vec3 target = trace_back(scene, args.velocity, place, -cells_per_speed);
  args.carried_smoke.at[index] = corrected(smoke, args.smoke.at[index],
                                           sample_cells(scene, args.smoke_forth, target).value);
  args.carried_temperature.at[index] =
      corrected(temperature, args.temperature.at[index],
                sample_cells(scene, args.temperature_forth, target).value);
}
