// What the compute kernels of the scene renderer read and write.
#ifndef PARITY_RASTER_SCENE_COMPUTE_LAYOUT_H
#define PARITY_RASTER_SCENE_COMPUTE_LAYOUT_H
#include "layout.h"
#include "scene_layout.h"

#ifdef __cplusplus
namespace parity {
#endif

// A triangle to rasterise is named by its draw and the first index of its element. Lines and points
// become two triangles each; the second has this bit in its first index.
const uint item_second_half = 0x80000000u;

struct SceneTriangleArgs {
  REF(SceneArgs) scene;
  REF(uvec2) items;
  REF(vec4) clip_positions;  // three an item
  REF(uvec3) triangles;
  REF(uint) flags;  // triangle_*
  uint count;
  uint width;
  uint height;
  uint padding;
};

struct SceneShadeArgs {
  REF(SceneArgs) scene;
  REF(uvec2) items;
  REF(vec4) clip_positions;
  REF(uint) elements;  // 1 + item in front at each sample, 0: none
  REF(float) depths;
  REF(uint) begins;
  REF(TileTriangle) tile_triangles;
  REF(vec4) out_color;  // one a pixel
  REF(float) out_depth;
  REF(uint) out_element;
  vec4 background;  // premultiplied
  uint width;
  uint height;
  uint has_unseen;  // some item is masked or blended
  uint padding;
};

// Pixels that sampling/refine.comp draws anew.
struct RefineArgs {
  REF(SceneArgs) scene;
  REF(uvec2) items;
  REF(vec4) clip_positions;
  REF(uint) begins;
  REF(TileTriangle) tile_triangles;
  REF(uint) pixels;  // y width + x
  REF(uint) averages;  // RGBA16F of the picture
  uint width;
  uint height;
  vec4 background;  // premultiplied
  uint tiles_x;
  uint pixel_count;
};

#ifdef __cplusplus
}
#endif
#endif
