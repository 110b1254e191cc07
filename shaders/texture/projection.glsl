// Places in space, or directions, to places in a texture. Source: notes 6.3; Vulkan 1.3, "Cube Map
// Face Selection"; Geiss 2007 (triplanar).
#ifndef PARITY_TEXTURE_PROJECTION_GLSL
#define PARITY_TEXTURE_PROJECTION_GLSL

const float half_turn = 3.14159265358979;

// The angle of (x, y) from the x axis, -pi to pi; off by less than 2^-22 of it and 2^-24. The
// quotient is brought below tan(pi / 8). Source: Moshier's Cephes (atanf).
float angle_of(float y, float x) {
  const float low = min(abs(x), abs(y));
  const float high = max(abs(x), abs(y));
  if (high == 0.0) return 0.0;
  const bool beyond = low > 0.4142135623730950 * high;
  const float t = beyond ? (low - high) / (low + high) : low / high;
  const float s = t * t;
  float angle = t + t * s * (-3.33329491539e-1 +
                             s * (1.99777106478e-1 + s * (-1.38776856032e-1 + s * 8.05374449538e-2)));
  if (beyond) angle += 0.25 * half_turn;
  if (abs(y) > abs(x)) angle = 0.5 * half_turn - angle;
  if (x < 0.0) angle = half_turn - angle;
  return y < 0.0 ? -angle : angle;
}

vec2 equirectangular_uv(vec3 d) {
  return vec2(0.5 + angle_of(d.x, -d.z) / (2.0 * half_turn),
              angle_of(sqrt(d.x * d.x + d.z * d.z), d.y) / half_turn);
}

// u, v and the face +x -x +y -y +z -z; of equal components z goes before y before x.
vec3 cube_place(vec3 d) {
  const vec3 a = abs(d);
  if (a.z >= a.x && a.z >= a.y)
    return vec3(0.5 + 0.5 * vec2(d.z < 0.0 ? -d.x : d.x, -d.y) / a.z, d.z < 0.0 ? 5.0 : 4.0);
  if (a.y >= a.x)
    return vec3(0.5 + 0.5 * vec2(d.x, d.y < 0.0 ? -d.z : d.z) / a.y, d.y < 0.0 ? 3.0 : 2.0);
  return vec3(0.5 + 0.5 * vec2(d.x < 0.0 ? d.z : -d.z, -d.y) / a.x, d.x < 0.0 ? 1.0 : 0.0);
}

vec3 triplanar_weights(vec3 n) {
  const vec3 w = n * n * n * n;
  return w / (w.x + w.y + w.z);
}
#endif
