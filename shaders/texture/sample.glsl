// Texture sampling in software: wrap, nearest and linear filters, mip levels. Texels are decoded
// first and filtered in linear light. Source: notes 6.3; Vulkan 1.3, "Texel Input Operations" and
// "Scale Factor Operation, Level-of-Detail".
#ifndef PARITY_TEXTURE_SAMPLE_GLSL
#define PARITY_TEXTURE_SAMPLE_GLSL
#include "raster/scene_layout.h"
#include "texture/anisotropic.glsl"

layout(constant_id = 21) const float anisotropic_level_bias = 0.5;  // 0 to 1: how coarse a level
layout(constant_id = 20) const bool has_borders = false;  // some texture is clamped to a border of 0

// 1 where texel `i` counts, 0 where it is the border's.
float border_weight(float i, float size, uint mode) {
  return mode == 3u && (i < 0.0 || i >= size) ? 0.0 : 1.0;
}

const uint mirror_once = 4u;  // with 2, clamp

// How an axis is wrapped: 0 repeat, 1 mirrored, 2 clamp, 3 border of 0, 6 mirrored once.
uint wrap_mode(SceneTexture t, uint shift, uint once) {
  return ((t.flags >> shift) & 3u) | ((t.flags & once) != 0u ? mirror_once : 0u);
}

// Where texel `i` (an integer as float) lies in an axis of `size` texels.
uint wrap_texel(float i, float size, uint mode) {
  const float period = mode == 1u ? 2.0 * size : size;
  float r = i - period * floor(i / period);
  // The quotient may have rounded across an integer.
  r += r < 0.0 ? period : (r >= period ? -period : 0.0);
  if (mode == 1u && r >= size) r = period - 1.0 - r;
  if (mode >= 2u) r = mode >= mirror_once && i < 0.0 ? -1.0 - i : i;
  // Last, so that no coordinate, however large or undefined, leaves the texture.
  return min(uint(clamp(r, 0.0, size - 1.0)), uint(size) - 1u);
}

vec4 decode_texel(uint texel, bool srgb, ref_float linear_from_srgb) {
  const vec4 value = unpackUnorm4x8(texel);
  if (!srgb) return value;
  return vec4(linear_from_srgb.at[texel & 255u], linear_from_srgb.at[(texel >> 8) & 255u],
              linear_from_srgb.at[(texel >> 16) & 255u], value.a);
}

bool stores_srgb(SceneTexture t) {
  const uint role = t.flags & texture_role_mask;
  return role == texture_base_color || role == texture_emission || role == texture_specular_color ||
         role == texture_sheen_color;
}

// The nearest level that is there: all that is read is.
uint kept_level(SceneTexture t, uint level) {
  return clamp(level, (t.flags >> texture_first_level_shift) & 15u,
               15u - ((t.flags >> texture_last_level_shift) & 15u));
}

// One level, filtered within it.
vec4 sample_level(SceneTexture t, uint wanted, bool linear, vec2 uv, ref_float linear_from_srgb) {
  const bool srgb = stores_srgb(t);
  const uint level = kept_level(t, wanted);
  const vec2 size = vec2(max(t.width >> level, 1u), max(t.height >> level, 1u));
  const uint wrap_u = wrap_mode(t, texture_wrap_u_shift, texture_mirror_once_u);
  const uint wrap_v = wrap_mode(t, texture_wrap_v_shift, texture_mirror_once_v);
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
  return 0.5 * log2(max(dot(dx, dx), dot(dy, dy)));
}

// One lookup at a level of detail.
vec4 sample_at_level(SceneTexture t, vec2 uv, float lambda, ref_float linear_from_srgb) {
  const float last = float(t.level_count - 1u);
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

// One level, averaged over an ellipse.
vec4 average_level(SceneTexture t, uint wanted, vec2 uv, Ellipse ellipse, ref_float linear_from_srgb) {
  const bool srgb = stores_srgb(t);
  const uint level = kept_level(t, wanted);
  const vec2 size = vec2(max(t.width >> level, 1u), max(t.height >> level, 1u));
  const uint wrap_u = wrap_mode(t, texture_wrap_u_shift, texture_mirror_once_u);
  const uint wrap_v = wrap_mode(t, texture_wrap_v_shift, texture_mirror_once_v);
  const uint first = t.texels.at[level];
  const EllipseRows rows = ellipse_rows(ellipse);
  precise const vec2 middle = uv * size - 0.5;
  vec4 sum = vec4(0.0);
  float weights = 0.0;
  [[dont_unroll]] for (float v = ceil(middle.y - rows.height); v <= middle.y + rows.height; ++v) {
    const float dy = v - middle.y;
    const float center = middle.x + rows.slope * dy;
    const float reach = rows.half_width * sqrt(max(rows.height * rows.height - dy * dy, 0.0));
    const uint row = first + wrap_texel(v, size.y, wrap_v) * uint(size.x);
    [[dont_unroll]] for (float u = ceil(center - reach); u <= center + reach; ++u) {
      const float weight = ellipse_weight(ellipse, vec2(u - middle.x, dy));
      const uint texel = t.texels.at[row + wrap_texel(u, size.x, wrap_u)];
      float w = weight;
      if (has_borders)
        w *= border_weight(u, size.x, wrap_u) * border_weight(v, size.y, wrap_v);
      sum += w * decode_texel(texel, srgb, linear_from_srgb);
      weights += weight;
    }
  }
  return sum / weights;
}

// A minified texture over an ellipse: averaged in the level in which its minor half axis is about a
// texel; over the last quarter of a level's range the next one is mixed in.
vec4 sample_ellipse(SceneTexture t, vec2 uv, vec2 duv_dx, vec2 duv_dy, Ellipse base, float most,
                    ref_float linear_from_srgb) {
  const float last = float(t.level_count - 1u);
  const float place = clamp(0.5 * log2(max(base.minor2, 1.0)) + anisotropic_level_bias, 0.0, last);
  const float level = floor(place);
  const float mix_weight = max(4.0 * (place - level) - 3.0, 0.0);
  vec4 sum = vec4(0.0);
  [[dont_unroll]] for (uint i = 0u; i < (mix_weight > 0.0 ? 2u : 1u); ++i) {
    const uint k = uint(level) + i;
    const vec2 size = vec2(max(t.width >> k, 1u), max(t.height >> k, 1u));
    const float w = i == 0u ? 1.0 - mix_weight : mix_weight;
    if (k + 1u >= t.level_count)
      sum += w * sample_level(t, k, true, uv, linear_from_srgb);
    else
      sum += w * average_level(t, k, uv,
                               with_texel(footprint_ellipse(duv_dx * size, duv_dy * size, most)),
                               linear_from_srgb);
  }
  return sum;
}

// A texture over a pixel's footprint.
vec4 sample_texture(SceneTexture t, vec2 uv, vec2 duv_dx, vec2 duv_dy, ref_float linear_from_srgb) {
  const float most = float((t.flags >> texture_anisotropy_shift) & 31u);
  if (most < 2.0) return sample_at_level(t, uv, level_of_detail(t, duv_dx, duv_dy), linear_from_srgb);
  const vec2 size = vec2(t.width, t.height);
  const Ellipse ellipse = footprint_ellipse(duv_dx * size, duv_dy * size, most);
  if (!(ellipse.major2 > 1.0 && ellipse.major2 < 1e18))
    return sample_at_level(t, uv, 0.5 * log2(ellipse.major2), linear_from_srgb);
  const vec4 average =
      sample_ellipse(t, uv, duv_dx, duv_dy, ellipse, most, linear_from_srgb);
  const float share = ellipse.major2 - 1.0;  // from the magnified texture to the ellipse
  return share >= 1.0 ? average
                      : mix(sample_level(t, 0u, true, uv, linear_from_srgb), average, share);
}
#endif
