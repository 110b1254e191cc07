// From clip positions to the window, and from there to fixed point. Source: notes 1.2, 1.4; Vulkan
// 1.3, "Controlling the Viewport"; the drivers' own arithmetic as measured.
#ifndef PARITY_RASTER_VIEWPORT_GLSL
#define PARITY_RASTER_VIEWPORT_GLSL

/// a + b = x + y exactly, x the rounded sum. Source: Knuth 1969 (two-sum).
vec2 exact_sum(float a, float b) {
  precise float x = a + b;
  precise float bb = x - a;
  precise float y = (a - (x - bb)) + (b - bb);
  return vec2(x, y);
}

/// a b = x + y exactly, x the rounded product. Source: Dekker 1971.
vec2 exact_product(float a, float b) {
  precise float x = a * b;
  precise float ta = 4097.0 * a, tb = 4097.0 * b;
  precise float ah = ta - (ta - a), bh = tb - (tb - b);
  precise float al = a - ah, bl = b - bh;
  precise float y = al * bl - (((x - ah * bh) - al * bh) - ah * bl);
  return vec2(x, y);
}

/// a + b rounded to odd: to the neighbour whose last bit is 1 if inexact.
float odd_sum(float a, float b) {
  const vec2 sum = exact_sum(a, b);
  if (sum.y == 0.0) return sum.x;
  const int bits = floatBitsToInt(sum.x);
  if ((bits & 1) != 0) return sum.x;
  const bool away = (sum.y > 0.0) == (sum.x > 0.0);
  return intBitsToFloat(bits + (away ? 1 : -1));
}

/// a b + c rounded once; the built-in fma need not fuse. Source: Boldo & Melquiond 2008.
float fused_multiply_add(float a, float b, float c) {
  const vec2 u = exact_product(a, b);
  const vec2 t = exact_sum(c, u.y);
  const vec2 v = exact_sum(u.x, t.x);
  precise float z = odd_sum(t.y, v.y);
  precise float result = v.x + z;
  return result;
}

/// Window x, y in pixels (y down), depth, and 1/w.
vec4 window_position(vec4 clip, vec2 size) {
  precise float r = 1.0 / clip.w;
  precise vec3 ndc = clip.xyz * r;
  return vec4(fused_multiply_add(ndc.x, 0.5 * size.x, 0.5 * size.x),
              fused_multiply_add(ndc.y, 0.5 * size.y, 0.5 * size.y), ndc.z, r);
}

/// Units of 1/256 pixel from the centre of pixel (0, 0), as Mesa's software rasteriser rounds.
ivec2 snap_mesa(vec2 window, uint samples) {
  precise vec2 shifted = samples == 1u ? (window - 0.5) * 256.0 : window * 256.0;
  return ivec2(roundEven(shifted)) - (samples == 1u ? 0 : 128);
}

/// The same in steps of 1/16 pixel, as SwiftShader rounds.
ivec2 snap_swiftshader(vec4 clip, vec2 size) {
  precise float r = 1.0 / clip.w;
  precise vec2 ndc = clip.xy * r;
  precise vec2 scaled = ndc * (8.0 * size) + (8.0 * size - 8.0);
  return ivec2(roundEven(scaled)) * 16;
}

/// `snapping` is the number of parity::Snapping. What is not finite or further than 2^15 pixels from
/// the window becomes a corner of it: such triangles are culled or clipped before.
ivec2 snap(vec4 clip, vec2 size, uint samples, uint snapping) {
  const vec4 window = window_position(clip, size);
  const vec2 limit = size + 32768.0;
  if (!(all(lessThan(window.xy, limit)) && all(greaterThan(window.xy, vec2(-32768.0)))))
    return ivec2(0);
  return snapping == 0u ? snap_mesa(window.xy, samples) : snap_swiftshader(clip, size);
}

#endif
