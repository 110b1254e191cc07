// What the texture kernels read and write.
#ifndef PARITY_TEXTURE_LAYOUT_H
#define PARITY_TEXTURE_LAYOUT_H
#include "../shared.h"

#ifdef __cplusplus
namespace parity {
#endif

// A pixel's place in a texture and what it changes to the next pixel right and down, in texture
// lengths.
struct TextureFootprint {
  vec2 uv;
  vec2 uv_dx;
  vec2 uv_dy;
};
REF_TYPE(TextureFootprint, 4)

struct TextureSampleArgs {
  REF(uint) texels;  // RGBA8: where each level begins, then level after level
  REF(float) linear_from_srgb;
  REF(TextureFootprint) footprints;
  REF(vec4) colors;
  uint width;
  uint height;
  uint level_count;
  uint flags;  // texture_* of raster/scene_layout.h
  uint count;
  uint padding;
};

struct HardwareSampleArgs {
  REF(TextureFootprint) footprints;
  REF(vec4) colors;
  uint count;
  uint padding;
};

// Each pointer is to the first texel of its level.
struct MipLevelArgs {
  REF(uint) codes_above;
  REF(vec4) means_above;
  REF(uint) codes;
  REF(vec4) means;
  uint width_above;
  uint height_above;
  uint width;
  uint height;
};

struct MipPairArgs {
  REF(uvec4) codes_above;
  REF(uvec2) codes;
  REF(uint) codes_below;
  REF(vec4) means_below;
  uint width;  // of the level above
  uint height;
};

#ifdef __cplusplus
}
#endif
#endif
