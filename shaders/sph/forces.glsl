// Accelerations between two particles; each is exactly the negative of its mirror image, so that
// momentum is kept to the rounding of the sums. Sources: notes 10.4; Monaghan 1992 (pressure,
// artificial viscosity); Monaghan 2005 (laminar viscosity); Becker & Teschner 2007 (surface
// tension); Akinci et al. 2012 (walls).

/// Viscous acceleration of i: both viscosities have the same form, the artificial one only between
/// particles that approach. `weight`: the other's mass over the mean density.
float viscous_factor(SphConstants c, vec3 d, vec3 dv, float r2, float laminar, float weight) {
  precise const float approach = inner_product(dv, d);
  precise const float strength = approach < 0.0 ? laminar + c.artificial : laminar;
  precise const float factor = weight * strength * approach / (r2 + c.softening);
  return factor;
}

/// From particle j of the fluid. places.w: density; motions.w: p / rho^2.
vec3 fluid_acceleration(SphConstants c, vec4 place_i, vec4 motion_i, vec4 place_j, vec4 motion_j) {
  precise const vec3 d = place_i.xyz - place_j.xyz;
  precise const vec3 dv = motion_i.xyz - motion_j.xyz;
  precise const float r2 = squared_length(d);
  precise const float slope = kernel_slope(r2, c.inverse_support, c.kernel_scale);
  precise const float pressure = c.mass * (motion_i.w + motion_j.w);
  precise const float weight = 2.0 * c.mass / (place_i.w + place_j.w);
  precise float along = (viscous_factor(c, d, dv, r2, c.laminar, weight) - pressure) * slope;
  if (c.tension != 0.0) along -= c.tension * kernel_value(r2, c.inverse_support, c.kernel_scale);
  precise const vec3 result = along * d;
  return result;
}

/// From a wall particle, which answers with the pressure of the particle that it sees, at its own
/// depth, but with no more than twice that (what falls along a wall is not held); wall.w: rest density times its volume; wall_motion.w: share of the viscosity. Source:
/// Adami et al. 2012, one to one.
vec3 wall_acceleration(SphConstants c, vec4 place, vec4 motion, vec4 wall, vec4 wall_motion) {
  precise const vec3 d = place.xyz - wall.xyz;
  precise const float r2 = squared_length(d);
  precise const float slope = kernel_slope(r2, c.inverse_support, c.kernel_scale);
  precise const float carried =
      clamp(motion.w - inner_product(c.gravity, d) / place.w, 0.0, 2.0 * motion.w);
  const float answer = c.stiff != 0u ? carried : 0.0;
  precise const vec3 dv = motion.xyz - wall_motion.xyz;
  precise const float laminar = wall_motion.w * c.laminar;
  precise const float viscous = viscous_factor(c, d, dv, r2, laminar, wall.w / place.w);
  precise const vec3 result = (viscous - wall.w * (motion.w + answer)) * slope * d;
  return result;
}
