#version 460
#pragma no_contraction
#include "raster/scene_fragment.glsl"

// One opaque fragment of a scene without textures and vertex colours.
void main() {
  const uint draw_flags = args.draws.at[0u].flags;
  out_color = finish(plain_fragment(draw_flags), 0u, draw_flags);
}
