#version 460
#pragma no_contraction
#include "raster/scene_varyings.glsl"

// One fragment of the scene, with logarithmic depth, and which element it is of.
layout(location = 1) out uint out_element;

void main() {
  gl_FragDepth = logarithmic_depth();
  out_color = shade();
  out_element = ids.y;
}
