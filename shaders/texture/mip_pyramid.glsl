// Texels of mip pyramids. Source: notes 6.3; averages are taken in linear light.
#ifndef PARITY_TEXTURE_MIP_PYRAMID_GLSL
#define PARITY_TEXTURE_MIP_PYRAMID_GLSL
#include "texture/layout.h"
#include "texture/srgb_curve.glsl"

layout(constant_id = 0) const bool srgb = true;

// Values from 0 to 255; colours of sRGB in linear light.
vec4 linear_texel(uint texel) {
  const ivec4 codes = ivec4(texel & 255u, texel >> 8 & 255u, texel >> 16 & 255u, texel >> 24);
  const vec4 value = vec4(codes);
  return srgb ? vec4(linear_from_srgb_curve(value.rgb), value.a) : value;
}

// Codes next to the values. Above 2^23 a float has no fraction: its low bits are the whole number.
uint stored_texel(vec4 linear) {
  const vec3 codes = srgb ? srgb_code_curve(linear.rgb) : linear.rgb;
  const uvec4 rounded = floatBitsToUint(vec4(codes, linear.a) + 8388608.0) & 255u;
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
