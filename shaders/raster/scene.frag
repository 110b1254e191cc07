#version 460
#pragma no_contraction
#include "raster/scene_varyings.glsl"

// One fragment of the scene.
void main() {
  out_color = shade();
}
