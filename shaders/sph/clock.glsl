// How long a step may be, and how time adds up.

/// Kick and drift with waves of angular frequency w and friction of rate g is stable while
/// 2 g dt + (w dt)^2 < 4 (the Jury conditions of z^2 - (2 - g dt - (w dt)^2) z + 1 - g dt).
float stable_step(float w2, float g) {
  precise const float root = sqrt(g * g + 4.0 * w2);
  precise const float result = 4.0 / (g + root);
  return result;
}

/// Fraction `courant` of the stable step, and of that in which a particle goes 0.8 of half the
/// support; nor is any accelerated through 1/4 of it. Source: Monaghan 1992, 2005.
float adaptive_step(SphConstants c, SphLimits limits) {
  float w2 = c.tension_rate;
  if (c.stiff != 0u) {
    precise const float ratio = max(limits.density / c.rest_density, 1.0);
    precise const float stiffening = c.tait != 0u ? ratio * ratio * ratio : 1.0;
    precise const float rate = c.wave_rate * c.sound_speed * stiffening;
    w2 += rate * rate;
  }
  precise const float half_support = 0.5 * c.support;
  float step = c.max_step;
  if (w2 > 0.0 || c.viscous_rate > 0.0)
    step = min(step, c.courant * stable_step(w2, c.viscous_rate));
  if (limits.speed > 0.0) step = min(step, c.courant * 0.8 * half_support / sqrt(limits.speed));
  if (limits.acceleration > 0.0)
    step = min(step, 0.25 * sqrt(half_support / sqrt(limits.acceleration)));
  return step;
}

/// Adds the step to the time, or goes to `until` exactly where the step would pass it; where two
/// steps would, half the way, so that no step is tiny. The two floats of the time are a sum without
/// rounding (Knuth's two-sum).
void advance_clock(inout SphClock clock, float step, float until, float until_rest) {
  precise const float remaining = (until - clock.time) + (until_rest - clock.time_rest);
  if (!(remaining > 0.0)) {
    clock.step = 0.0;
    return;
  }
  clock.steps += 1u;
  if (!(step < remaining)) {
    clock.step = remaining;
    clock.time = until;
    clock.time_rest = until_rest;
    return;
  }
  precise const float length = remaining < 2.0 * step ? 0.5 * remaining : step;
  clock.step = length;
  precise const float addend = clock.time_rest + length;
  precise const float sum = clock.time + addend;
  precise const float shown = sum - clock.time;
  precise const float rest = (clock.time - (sum - shown)) + (addend - shown);
  clock.time = sum;
  clock.time_rest = rest;
}
