// The fragment stage of scenes with textures or vertex colours.
#ifndef PARITY_RASTER_SCENE_VARYINGS_GLSL
#define PARITY_RASTER_SCENE_VARYINGS_GLSL
#include "raster/scene_fragment.glsl"

layout(location = 2) in vec4 tangent;
layout(location = 3) in vec4 color;
layout(location = 4) flat in uvec3 ids;
layout(location = 5) in vec4 uv[3];

// Colour (straight) and alpha of this fragment, unless it is cut out.
vec4 shade() {
  Fragment f = plain_fragment(ids.x);
  f.scale = uintBitsToFloat(ids.z);
  if (has_normal_maps) f.tangent = tangent;
  // White that is interpolated may round to less.
  if (has_colors && (ids.x & draw_flag_colors) != 0u) f.color = color;
  [[unroll]] for (uint i = 0u; i < 3u; ++i) {
    if (!has_textures || i >= uv_pair_count) continue;
    f.uv[i] = uv[i];
    f.uv_dx[i] = dFdxFine(uv[i]);
    f.uv_dy[i] = dFdyFine(uv[i]);
  }
  return finish(f, ids.x >> draw_flag_bits, ids.x);
}
#endif
