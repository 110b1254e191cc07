#version 460
#pragma no_contraction
#include "raster/scene_varyings.glsl"

// One fragment of the scene, with logarithmic depth.
void main() {
  gl_FragDepth = logarithmic_depth();
  out_color = shade();
}
