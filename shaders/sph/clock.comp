#version 460
#include "sph/layout.h"
#include "sph/clock.glsl"

// Chooses the step from the limits of all blocks and moves the clock; one thread.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { ClockArgs args; };

void main() {
  if (gl_GlobalInvocationID.x != 0u) return;
  const SphConstants c = args.constants.at[0];
  SphLimits limits = SphLimits(0.0, 0.0, 0.0, 0u);
  for (uint block = 0u; block < args.blocks; ++block) {
    const SphLimits other = args.limits.at[block];
    limits.speed = max(limits.speed, other.speed);
    limits.acceleration = max(limits.acceleration, other.acceleration);
    limits.density = max(limits.density, other.density);
    limits.crowded += other.crowded;
  }
  SphClock clock = args.clock.at[0];
  clock.max_speed = sqrt(limits.speed);
  clock.max_acceleration = sqrt(limits.acceleration);
  clock.max_density = limits.density;
  clock.crowded += limits.crowded;
  const float step = c.fixed_step > 0.0 ? c.fixed_step : adaptive_step(c, limits);
  advance_clock(clock, step, args.until, args.until_rest);
  args.clock.at[0] = clock;
}
