// The implicit viscosity: velocities x with x - dt A x = v, where A x are the viscous accelerations
// that x causes. Symmetric and positive definite, as each pair takes from both the part of their
// velocities along the line between them. Sources: Weiler et al. 2018; Monaghan 2005.

/// What one pair adds to A x at i; odd in d and dv together, so that momentum is kept.
vec3 viscous_acceleration(SphConstants c, vec3 d, vec3 dv, float weight) {
  precise const float r2 = squared_length(d);
  precise const float slope = kernel_slope(r2, c.inverse_support, c.kernel_scale);
  precise const float along = weight * c.implicit * slope * inner_product(dv, d);
  precise const vec3 result = along / (r2 + c.softening) * d;
  return result;
}
