// One step of each method, as the change of the state. Sources: notes 10.1; Kutta 1901 (RK4);
// Dormand & Prince 1980.
#include "ode/systems.glsl"

layout(constant_id = 0) const uint ode_method = 0u;  // of parity::OdeMethod

/// d = (1 - theta) h f(s, t) + theta h f(s + d, t + h) by Newton's method.
vec2 implicit_change(vec2 s, float t, float h, vec2 p, float theta, inout uint evaluations) {
  precise const vec2 known = (1.0 - theta) * h * ode_slope(s, t, p);
  precise vec2 d = known / (1.0 - theta == 0.0 ? 1.0 : 1.0 - theta);
  evaluations += 1u;
  for (int round = 0; round < 12; ++round) {
    precise const vec2 off = d - known - theta * h * ode_slope(s + d, t + h, p);
    evaluations += 1u;
    precise const mat2 j = mat2(1.0, 0.0, 0.0, 1.0) - theta * h * ode_jacobian(s + d, p);
    precise const float determinant = j[0].x * j[1].y - j[1].x * j[0].y;
    precise const vec2 change =
        vec2(j[1].y * off.x - j[1].x * off.y, j[0].x * off.y - j[0].y * off.x) / determinant;
    d -= change;
    const float size = max(abs(s.x) + abs(s.y), abs(d.x) + abs(d.y));
    if (!(abs(change.x) + abs(change.y) > 2.4e-7 * size)) break;
  }
  return d;
}

/// First the velocity, then the place with the new velocity.
vec2 symplectic_change(vec2 s, float t, float h, vec2 p) {
  precise const float kick = h * ode_slope(s, t, p).y;
  precise const float drift = h * ode_slope(vec2(s.x, s.y + kick), t, p).x;
  return vec2(drift, kick);
}

vec2 rk4_change(vec2 s, float t, float h, vec2 p) {
  precise const vec2 a = ode_slope(s, t, p);
  precise const vec2 b = ode_slope(s + 0.5 * h * a, t + 0.5 * h, p);
  precise const vec2 c = ode_slope(s + 0.5 * h * b, t + 0.5 * h, p);
  precise const vec2 d = ode_slope(s + h * c, t + h, p);
  precise const vec2 change = h / 6.0 * (a + 2.0 * (b + c) + d);
  return change;
}

vec2 fixed_change(vec2 s, float t, float h, vec2 p, inout uint evaluations) {
  if (ode_method == 1u) {
    evaluations -= 1u;  // the slope at the start has weight 0
    return implicit_change(s, t, h, p, 1.0, evaluations);
  }
  if (ode_method == 2u) {
    evaluations += 2u;
    return symplectic_change(s, t, h, p);
  }
  if (ode_method == 3u) return implicit_change(s, t, h, p, 0.5, evaluations);
  if (ode_method == 4u) {
    evaluations += 2u;
    precise const vec2 middle = s + 0.5 * h * ode_slope(s, t, p);
    precise const vec2 change = h * ode_slope(middle, t + 0.5 * h, p);
    return change;
  }
  if (ode_method == 5u) {
    evaluations += 4u;
    return rk4_change(s, t, h, p);
  }
  evaluations += 1u;
  precise const vec2 change = h * ode_slope(s, t, p);
  return change;
}

/// Change of fifth order, and its difference from that of fourth order.
struct EmbeddedChange {
  vec2 change;
  vec2 error;
};

EmbeddedChange dormand_prince_change(vec2 s, float t, float h, vec2 p) {
  precise const vec2 a = h * ode_slope(s, t, p);
  precise const vec2 b = h * ode_slope(s + a * 0.2, t + 0.2 * h, p);
  precise const vec2 c = h * ode_slope(s + (a * 0.075 + b * 0.225), t + 0.3 * h, p);
  precise const vec2 d =
      h * ode_slope(s + (a * (44.0 / 45.0) - b * (56.0 / 15.0) + c * (32.0 / 9.0)), t + 0.8 * h, p);
  precise const vec2 e = h * ode_slope(s + (a * (19372.0 / 6561.0) - b * (25360.0 / 2187.0) +
                                            c * (64448.0 / 6561.0) - d * (212.0 / 729.0)),
                                       t + h * (8.0 / 9.0), p);
  precise const vec2 f =
      h * ode_slope(s + (a * (9017.0 / 3168.0) - b * (355.0 / 33.0) + c * (46732.0 / 5247.0) +
                         d * (49.0 / 176.0) - e * (5103.0 / 18656.0)),
                    t + h, p);
  precise const vec2 change = a * (35.0 / 384.0) + c * (500.0 / 1113.0) + d * (125.0 / 192.0) -
                              e * (2187.0 / 6784.0) + f * (11.0 / 84.0);
  precise const vec2 g = h * ode_slope(s + change, t + h, p);
  precise const vec2 error = a * (71.0 / 57600.0) - c * (71.0 / 16695.0) + d * (71.0 / 1920.0) -
                             e * (17253.0 / 339200.0) + f * (22.0 / 525.0) - g * (1.0 / 40.0);
  return EmbeddedChange(change, error);
}
