// Right-hand sides f(x, t) and their Jacobians.
#include "transform/trigonometry.glsl"

layout(constant_id = 1) const uint ode_system = 0u;  // of parity::OdeSystem

vec2 ode_slope(vec2 s, float t, vec2 p) {
  precise vec2 f;
  if (ode_system == 0u) {
    f = vec2(p.x * s.x - p.y * s.y, p.y * s.x + p.x * s.y);
  } else if (ode_system == 1u) {
    f = vec2(s.y, -(p.x * p.x) * s.x);
  } else if (ode_system == 2u) {
    f = vec2(s.y, -(p.x * p.x) * sin_cos(s.x).x);
  } else if (ode_system == 3u) {
    f = vec2(s.y, p.x * (1.0 - s.x * s.x) * s.y - s.x);
  } else {
    const vec2 driver = sin_cos(t);
    f = vec2(p.x * (s.x - driver.y) - driver.x, p.y * s.y);
  }
  return f;
}

/// Columns are derivatives by x and by y.
mat2 ode_jacobian(vec2 s, vec2 p) {
  if (ode_system == 0u) return mat2(p.x, p.y, -p.y, p.x);
  if (ode_system == 1u) return mat2(0.0, -(p.x * p.x), 1.0, 0.0);
  if (ode_system == 2u) return mat2(0.0, -(p.x * p.x) * sin_cos(s.x).y, 1.0, 0.0);
  if (ode_system == 3u)
    return mat2(0.0, -2.0 * p.x * s.x * s.y - 1.0, 1.0, p.x * (1.0 - s.x * s.x));
  return mat2(p.x, 0.0, 0.0, p.y);
}
