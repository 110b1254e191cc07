#version 460
#pragma no_contraction
#include "raster/scene_pull.glsl"

// One vertex of opaque scenes without textures and vertex colours: what is not written is not
// interpolated either, and specialization does not take outputs away.
void main() {
  pull_vertex();
}
