#version 460
#pragma no_contraction
#include "raster/scene_varyings.glsl"

// One fragment of the scene, and which element it is of.
layout(location = 1) out uint out_element;

void main() {
  out_color = shade();
  out_element = ids.y;
}
