// Unit quaternions (x, y, z, w), w real. Source: notes 2.7.
#ifndef PARITY_TRANSFORM_QUATERNION_GLSL
#define PARITY_TRANSFORM_QUATERNION_GLSL

/// R = I + 2 s [v]x + 2 [v]x^2, columns.
mat3 quaternion_matrix(vec4 q) {
  precise vec3 square = 2.0 * q.xyz * q.xyz;
  precise vec3 mixed = 2.0 * q.xyz * q.yzx;  // xy, yz, zx
  precise vec3 real = 2.0 * q.w * q.xyz;
  precise mat3 m = mat3(1.0 - (square.y + square.z), mixed.x + real.z, mixed.z - real.y,
                        mixed.x - real.z, 1.0 - (square.x + square.z), mixed.y + real.x,
                        mixed.z + real.y, mixed.y - real.x, 1.0 - (square.x + square.y));
  return m;
}

/// q v q^-1 in 15 products: v + 2 (s u x v + u x (u x v)).
vec3 quaternion_rotate(vec4 q, vec3 v) {
  precise vec3 t = 2.0 * cross(q.xyz, v);
  precise vec3 result = v + q.w * t + cross(q.xyz, t);
  return result;
}

/// sin(t angle) / sin(angle) by its series in cos(angle) - 1, for angles up to a right one. All terms
/// are positive; what is left out is below 2^-24. At angle 0 it is t. No arc cosine, no sine.
/// Source: Eberly 2011, "A Fast and Accurate Algorithm for Computing SLERP".
float sine_ratio(float t, float cosine_less_one) {
  precise float sum = t, term = t;
  for (int i = 1; i <= 24; ++i) {
    const float n = float(i);
    term *= (t * t - n * n) * cosine_less_one / (n * (2.0 * n + 1.0));
    sum += term;
  }
  return sum;
}

/// Constant angular speed along the shorter arc. Erratum: notes 2.7 take the longer arc where the dot
/// product is negative, and divide by sin 0.
vec4 slerp(vec4 from, vec4 to, float t) {
  precise float side = dot(from, to);
  const vec4 end = side < 0.0 ? -to : to;
  const vec4 chord = end - from;
  precise float cosine_less_one = -0.5 * dot(chord, chord);  // no cancellation at small angles
  precise vec4 result = sine_ratio(1.0 - t, cosine_less_one) * from +
                        sine_ratio(t, cosine_less_one) * end;
  return result;
}

#endif
