// Texture sampling in software: wrap, nearest and linear filters, mip levels. Texels are decoded
// first and filtered in linear light. Source: notes 6.3; Vulkan 1.3, "Texel Input Operations" and
// "Scale Factor Operation, Level-of-Detail".
#ifndef PARITY_TEXTURE_SAMPLE_GLSL
#define PARITY_TEXTURE_SAMPLE_GLSL
#include "raster/scene_layout.h"

layout(constant_id = 20) const bool has_borders = false;  // some texture is clamped to a border of 0

// 1 where texel `i` counts, 0 where it is the border's.
float border_weight(float i, float size, uint mode) {
  return mode == 3u && (i < 0.0 || i >= size) ? 0.0 : 1.0;
}

// Where texel `i` (an integer as float) lies in an axis of `size` texels.
uint wrap_texel(float i, float size, uint mode) {
  const float period = mode == 1u ? 2.0 * size : size;
  float r = i - period * floor(i / period);
  // The quotient may have rounded across an integer.
  r += r < 0.0 ? period : (r >= period ? -period : 0.0);
  if (mode == 1u && r >= size) r = period - 1.0 - r;
  if (mode >= 2u) r = i;
  // Last, so that no coordinate, however large or undefined, leaves the texture.
  return min(uint(clamp(r, 0.0, size - 1.0)), uint(size) - 1u);
}

vec4 decode_texel(uint texel, bool srgb, ref_float linear_from_srgb) {
  const vec4 value = unpackUnorm4x8(texel);
  if (!srgb) return value;
  return vec4(linear_from_srgb.at[texel & 255u], linear_from_srgb.at[(texel >> 8) & 255u],
              linear_from_srgb.at[(texel >> 16) & 255u], value.a);
}

// One level, filtered within it.
vec4 sample_level(SceneTexture t, uint level, bool linear, vec2 uv, ref_float linear_from_srgb) {
  const uint role = t.flags & texture_role_mask;
  const bool srgb = role == texture_base_color || role == texture_emission;
  const vec2 size = vec2(max(t.width >> level, 1u), max(t.height >> level, 1u));
  const uint wrap_u = (t.flags >> texture_wrap_u_shift) & 3u;
  const uint wrap_v = (t.flags >> texture_wrap_v_shift) & 3u;
  const uint first = t.texels.at[level];
  precise const vec2 p = linear ? uv * size - 0.5 : uv * size;
  const vec2 low = floor(p);
  const vec2 weight = linear ? p - low : vec2(0.0);
  const uint x0 = wrap_texel(low.x, size.x, wrap_u);
  const uint x1 = linear ? wrap_texel(low.x + 1.0, size.x, wrap_u) : x0;
  const uint y0 = wrap_texel(low.y, size.y, wrap_v);
  const uint y1 = linear ? wrap_texel(low.y + 1.0, size.y, wrap_v) : y0;
  vec4 sum = vec4(0.0);
  [[dont_unroll]] for (uint corner = 0u; corner < (linear ? 4u : 1u); ++corner) {
    const bool right = (corner & 1u) != 0u;
    const bool lower = (corner & 2u) != 0u;
    const uint texel = t.texels.at[first + (lower ? y1 : y0) * uint(size.x) + (right ? x1 : x0)];
    float w = (right ? weight.x : 1.0 - weight.x) * (lower ? weight.y : 1.0 - weight.y);
    if (has_borders)
      w *= border_weight(low.x + (right ? 1.0 : 0.0), size.x, wrap_u) *
           border_weight(low.y + (lower ? 1.0 : 0.0), size.y, wrap_v);
    sum += w * decode_texel(texel, srgb, linear_from_srgb);
  }
  return sum;
}

// log2 of the longer side of a pixel's footprint in texels of level 0; at most 0 magnifies.
float level_of_detail(SceneTexture t, vec2 duv_dx, vec2 duv_dy) {
  const vec2 size = vec2(t.width, t.height);
  const vec2 dx = duv_dx * size;
  const vec2 dy = duv_dy * size;
  const float rho_squared = max(dot(dx, dx), dot(dy, dy));
  return rho_squared > 0.0 ? 0.5 * log2(rho_squared) : -126.0;
}

vec4 sample_texture(SceneTexture t, vec2 uv, vec2 duv_dx, vec2 duv_dy, ref_float linear_from_srgb) {
  const float last = float(t.level_count - 1u);
  const float lambda = level_of_detail(t, duv_dx, duv_dy);
  const bool magnify = !(lambda > 0.0);
  const bool linear = (t.flags & (magnify ? texture_linear_mag : texture_linear_min)) != 0u;
  float level = 0.0;
  float mix_weight = 0.0;
  if (!magnify && (t.flags & texture_mip_nearest) != 0u)
    level = clamp(ceil(lambda + 0.5) - 1.0, 0.0, last);
  if (!magnify && (t.flags & texture_mip_linear) != 0u) {
    const float clamped = min(lambda, last);
    level = floor(clamped);
    mix_weight = clamped - level;
  }
  vec4 sum = vec4(0.0);
  [[dont_unroll]] for (uint i = 0u; i < (mix_weight > 0.0 ? 2u : 1u); ++i) {
    const float w = i == 0u ? 1.0 - mix_weight : mix_weight;
    sum += w * sample_level(t, uint(level) + i, linear, uv, linear_from_srgb);
  }
  return sum;
}
#endif
