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
  uint row;  // footprints a row of the target; fragments only
};

// Kernels that give a vector to each point.
struct PointMapArgs {
  REF(vec4) inputs;
  REF(vec4) outputs;
  REF(uint) permutation;  // of 0..255, for noise
  uint count;
  uint kind;
};

const uint procedural_octave_count = 6u;

struct EnvironmentArgs {
  REF(vec4) texels;  // equirectangular, or six faces
  REF(vec4) directions;
  REF(vec4) colors;
  uint width;
  uint height;
  uint count;
  uint cube;
};

// A point of a surface, and what bends its normal.
struct SurfaceDetail {
  vec3 normal;
  vec4 tangent;  // w: handedness
  vec3 p_u;      // derivatives of the surface by u and v
  vec3 p_v;
  vec2 slope;    // of the height, by u and v
  vec3 texel;    // of the normal map, 0 to 1
  float scale;   // of the normal map
};
REF_TYPE(SurfaceDetail, 4)

struct SurfaceDetailArgs {
  REF(SurfaceDetail) details;
  REF(vec4) normals;
  uint count;
  uint kind;
};

struct ParallaxRay {
  vec2 uv;
  vec3 to_eye;  // in tangent space
};
REF_TYPE(ParallaxRay, 4)

struct ParallaxArgs {
  REF(uint) texels;  // where the level begins, then its RGBA8
  REF(float) linear_from_srgb;  // not read
  REF(ParallaxRay) rays;
  REF(vec4) hits;  // uv, depth
  uint width;
  uint height;
  uint layers;
  uint count;
  float scale;
  uint padding;
};

struct DisplacementVertex {
  vec3 position;
  vec3 normal;
  vec2 uv;
};
REF_TYPE(DisplacementVertex, 4)

const uint displacement_samples = 32u;  // places at which an edge's error is taken; most parts

struct DisplacementArgs {
  mat4 clip_from_world;
  REF(uint) heights;  // 3, width, height, then RGBA8 texels
  REF(DisplacementVertex) vertices;  // three a triangle
  REF(uvec4) factors;                // of the edges opposite corners 0, 1, 2 and of the inside
  REF(uint) begins;  // of each triangle's small ones; before the prefix sum, how many
  REF(vec3) corners;
  vec2 size;  // of the picture, px
  float scale;
  float max_pixels;
  uint count;
  uint small_count;
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

struct MipTripleArgs {
  REF(uvec4) codes_above;
  REF(uvec2) codes;
  REF(uint) codes_second;
  REF(uint) codes_third;
  REF(vec4) means_third;
  uint width;  // of the level above
  uint height;
};

#ifdef __cplusplus
}
#endif
#endif
