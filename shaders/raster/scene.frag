#version 460
#include "raster/scene_varyings.glsl"

// One fragment of the scene.
void main() {
  out_color = shade();
}
