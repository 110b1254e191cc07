// How a layer goes on top of another. Source: notes 1.7; Porter & Duff 1984; Vulkan 1.3, "Blending".
#ifndef PARITY_RASTER_BLEND_GLSL
#define PARITY_RASTER_BLEND_GLSL

vec4 blend_over(vec4 top, vec4 below) {
  precise vec4 result = vec4(top.rgb * top.a, top.a) + (1.0 - top.a) * below;
  return result;
}

vec4 blend_over_premultiplied(vec4 top, vec4 below) {
  precise vec4 result = top + (1.0 - top.a) * below;
  return result;
}

/// `mode` is the number of parity::BlendMode.
vec4 blend(vec4 top, vec4 below, uint mode) {
  if (mode == 0u) return blend_over(top, below);
  if (mode == 1u) return blend_over_premultiplied(top, below);
  precise vec4 sum = top + below;
  return sum;
}

#endif
