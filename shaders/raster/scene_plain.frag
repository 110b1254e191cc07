#version 460
#pragma no_contraction
#include "raster/scene_fragment.glsl"

// One fragment of a scene without textures and vertex colours.
void main() {
  out_color = finish(plain_fragment());
}
