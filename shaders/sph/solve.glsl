// The pressure solver's sums over neighbours. Sources: Bender & Koschier 2015; Ihmsen et al. 2014.

/// Least density over that at rest inside the fluid: parity::sph_inside_density.
const float inside_density = 0.9;

/// Gradient of W at i.
vec3 kernel_gradient(SphConstants c, vec3 d) {
  precise const vec3 gradient = kernel_slope(squared_length(d), c.inverse_support, c.kernel_scale) * d;
  return gradient;
}
