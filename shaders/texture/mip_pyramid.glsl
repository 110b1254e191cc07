// Texels of mip pyramids. Source: notes 6.3; averages are taken in linear light.
#ifndef PARITY_TEXTURE_MIP_PYRAMID_GLSL
#define PARITY_TEXTURE_MIP_PYRAMID_GLSL
#include "texture/layout.h"
#include "texture/srgb_curve.glsl"

layout(constant_id = 0) const bool srgb = true;

vec4 linear_texel(uint texel) {
  const vec4 value = unpackUnorm4x8(texel);
  return srgb ? vec4(linear_from_srgb_curve(value.rgb), value.a) : value;
}

uint stored_texel(vec4 linear) {
  const vec3 codes = srgb ? srgb_code_curve(linear.rgb) : linear.rgb * 255.0;
  const uvec4 rounded = uvec4(vec4(codes, linear.a * 255.0) + 0.5);
  return rounded.x | rounded.y << 8 | rounded.z << 16 | rounded.w << 24;
}

// Texels of the longer side that output i of `to` covers: the first one, and the shares of it and
// of the next two. Texel j is [j to, (j + 1) to) and the output [i from, (i + 1) from), in units
// in which both sides are from * to long.
struct Taps {
  uint first;
  vec3 weight;
};

Taps box_taps(uint i, uint from, uint to) {
  const uint begin = i * from;
  const uint first = begin / to;
  uvec3 overlap;
  for (uint k = 0u; k < 3u; ++k) {
    const uint left = max(begin, (first + k) * to);
    const uint right = min(begin + from, (first + k + 1u) * to);
    overlap[k] = right > left ? right - left : 0u;
  }
  return Taps(first, vec3(overlap) / float(from));
}
#endif
