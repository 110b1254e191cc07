// Pictures of all directions, read bilinearly without seams. Source: notes 6.3; Vulkan 1.3, "Cube
// Map Edge Handling".
#ifndef PARITY_TEXTURE_ENVIRONMENT_GLSL
#define PARITY_TEXTURE_ENVIRONMENT_GLSL
#include "texture/layout.h"
#include "texture/projection.glsl"

// Texel of an equirectangular picture; one column or row outside is fine.
vec4 equirectangular_texel(ref_vec4 texels, ivec2 size, ivec2 at) {
  if (at.y < 0 || at.y >= size.y) at.x += size.x / 2;
  at.x += at.x < 0 ? size.x : 0;
  at.x -= at.x >= size.x ? size.x : 0;
  at.x = min(at.x, size.x - 1);
  return texels.at[clamp(at.y, 0, size.y - 1) * size.x + at.x];
}

vec4 sample_equirectangular(ref_vec4 texels, ivec2 size, vec3 direction) {
  const vec2 p = equirectangular_uv(direction) * vec2(size) - 0.5;
  const ivec2 low = ivec2(floor(p));
  vec4 sum = vec4(0.0);
  [[dont_unroll]] for (int corner = 0; corner < 4; ++corner) {
    const ivec2 at = low + ivec2(corner & 1, corner >> 1);
    const vec2 w = 1.0 - abs(vec2(at) - p);
    sum += w.x * w.y * equirectangular_texel(texels, size, at);
  }
  return sum;
}

// The point of face `face`, side 2, that is (u, v) from its middle to the right and down.
vec3 cube_point(int face, float u, float v, float out_length) {
  const float sign = (face & 1) == 0 ? 1.0 : -1.0;
  if (face < 2) return vec3(sign * out_length, -v, -sign * u);
  if (face < 4) return vec3(u, sign * out_length, sign * v);
  return vec3(sign * u, -v, sign * out_length);
}

// A texel beyond one edge belongs to the neighbour, which is folded down there.
vec4 folded_texel(ref_vec4 texels, int side, int face, ivec2 at) {
  vec2 p = (2.0 * vec2(at) + 1.0) / float(side) - 1.0;
  float out_length = 1.0;
  if (any(greaterThan(abs(p), vec2(1.0)))) {
    p = clamp(p, -1.0, 1.0);
    out_length = 1.0 - 1.0 / float(side);
  }
  const vec3 place = cube_place(cube_point(face, p.x, p.y, out_length));
  const ivec2 texel = ivec2(place.xy * float(side));
  return texels.at[(int(place.z) * side + texel.y) * side + texel.x];
}

vec4 cube_texel(ref_vec4 texels, int side, int face, ivec2 at) {
  const ivec2 inner = clamp(at, 0, side - 1);
  if (inner.x == at.x || inner.y == at.y) return folded_texel(texels, side, face, at);
  return (folded_texel(texels, side, face, ivec2(at.x, inner.y)) +
          folded_texel(texels, side, face, ivec2(inner.x, at.y)) +
          folded_texel(texels, side, face, inner)) / 3.0;
}

vec4 sample_cube_map(ref_vec4 texels, int side, vec3 direction) {
  const vec3 place = cube_place(direction);
  const vec2 p = place.xy * float(side) - 0.5;
  const ivec2 low = ivec2(floor(p));
  vec4 sum = vec4(0.0);
  [[dont_unroll]] for (int corner = 0; corner < 4; ++corner) {
    const ivec2 at = low + ivec2(corner & 1, corner >> 1);
    const vec2 w = 1.0 - abs(vec2(at) - p);
    sum += w.x * w.y * cube_texel(texels, side, int(place.z), at);
  }
  return sum;
}
#endif
