#version 460
#include "numerics/layout.h"
#include "fluid/layout.h"
#include "fluid/grid.glsl"

// Chooses the step, or ends it; one thread. Source: notes 10.4 (CFL); row 169 for explicit diffusion:
// step <= spacing^2 / (2 d viscosity), not the notes' spacing^2 / (2 viscosity). The interval of
// stability of the Runge-Kutta method of order 3 is 2.51 on the real axis, 1.73 on the imaginary.
layout(local_size_x = 1) in;
layout(scalar, push_constant) uniform Push { FluidArgs args; };

const uint begin_step = 0u;
const uint end_step = 1u;
/// Cells along z or y may be one: then that axis counts for nothing.
float dimensions(FluidScene scene) {
  float count = 0.0;
  for (uint d = 0u; d < 3u; ++d) count += scene.cells[d] > 1u ? 1.0 : 0.0;
  return count;
}

float stable_step(FluidScene scene, float sum, float largest) {
  const float h = scene.spacing;
  const float diffusion = scene.viscosity * dimensions(scene) / (h * h);
  if (scene.method <= fluid_central) {
    const float advection = (sum + sqrt(h * scene.acceleration)) / h;
    const float limit = scene.method == fluid_central ? 1.73 : 1.25;
    return scene.courant / max(advection / limit + 4.0 * diffusion / 2.51, 1e-30);
  }
  const float advection = (largest + sqrt(h * scene.acceleration)) / h;
  float step = scene.courant / max(advection, 1e-30);
  // Implicit diffusion is stable at any step; its sweeps converge in time for 10 explicit ones.
  const float explicit_limit = 0.5 / max(diffusion, 1e-30);
  return min(step, (scene.implicit_viscosity != 0u ? 10.0 : 0.9) * explicit_limit);
}

void main() {
  FluidScene scene = args.scene.at[0];
  FluidClock clock = args.clock.at[0];
  if (args.mode == end_step) {
    args.clock.at[0].time = clock.time + clock.step;
    args.clock.at[0].steps = clock.steps + (clock.step > 0.0 ? 1u : 0u);
    return;
  }
  float sum = 0.0, largest = 0.0;
  uint k = 0u;
  const uint run = uint(args.weight);
  for (uint axis = 0u; axis < 3u; ++axis) {
    const uint chunks =
        run == 0u ? tile_speeds : (point_count(points_of(scene.cells, axis)) + run - 1u) / run;
    float most = 0.0;
    for (uint c = 0u; c < chunks; ++c) most = max(most, args.field.at[k + c]);
    k += chunks;
    sum += most;
    largest = max(largest, most);
  }
  args.clock.at[0].speed = sum;
  float step = scene.fixed_step;
  if (step == 0.0) step = min(stable_step(scene, sum, largest), scene.max_step);
  const float left = clock.end - clock.time;
  // The last steps are equal, so that none is tiny; rounding of the time is no step.
  if (left < 2.0 * step) step = left > step ? (scene.fixed_step == 0.0 ? 0.5 * left : step) : left;
  if (left <= 1e-6 * clock.end) step = 0.0;
  args.clock.at[0].step = step;
}
