// What the scene renderer's shaders read. Positions are relative to SceneArgs' origin, which the
// host subtracts in double: the eye of a perspective camera.
#ifndef PARITY_RASTER_SCENE_LAYOUT_H
#define PARITY_RASTER_SCENE_LAYOUT_H
#include "../shared.h"

#ifdef __cplusplus
namespace parity {
#endif

// One draw: a primitive in one place. Attribute arrays without their bit in `flags` must not be read.
struct SceneDraw {
  mat4 clip_from_object;
  mat3 world_from_object;
  vec3 world_origin;  // of the object, relative to the origin
  mat3 world_from_object_normal;  // up to a positive factor
  REF(vec3) positions;
  REF(vec3) normals;
  REF(vec4) tangents;
  REF(vec4) colors;
  REF(vec2) uvs[6];  // by slot of the material
  REF(uint) indices;
  uint material;
  uint flags;          // draw_flag_*
  uint corners;        // of an element: 1, 2, 3
  uint first_element;  // number of the first one through all draws
};
REF_TYPE(SceneDraw, 8)

const uint draw_flag_mirrored = 1u;
const uint draw_flag_unlit = 2u;  // points and lines
const uint draw_flag_normals = 4u;
const uint draw_flag_tangents = 8u;
const uint draw_flag_colors = 16u;
const uint draw_flag_uvs = 256u;  // times 2^slot

struct SceneMaterial {
  vec4 base_color;
  vec3 emission;
  float metallic;
  float roughness;
  float normal_scale;
  float occlusion_strength;
  float alpha_cutoff;
  uint flags;  // material_flag_*
  uint first_texture;
  uint texture_count;
};
REF_TYPE(SceneMaterial, 4)

const uint material_flag_mask = 1u;
const uint material_flag_blend = 2u;
const uint material_flag_double_sided = 4u;
const uint material_flag_unlit = 8u;

// One use of a texture by a material.
struct SceneTexture {
  REF(uint) texels;  // RGBA8, the levels' first texels, then level after level
  vec3 u_from_uv;    // u = dot(u_from_uv, (u, v, 1))
  vec3 v_from_uv;
  uint width;
  uint height;
  uint level_count;
  uint flags;  // texture_*
};
REF_TYPE(SceneTexture, 8)

const uint texture_role_mask = 7u;  // what it is for:
const uint texture_base_color = 0u;
const uint texture_metallic_roughness = 1u;
const uint texture_normal = 2u;
const uint texture_occlusion = 3u;
const uint texture_emission = 4u;
const uint texture_slot_shift = 3u;  // 3 bits: the slot of its uv
const uint texture_wrap_u_shift = 6u;  // 2 bits: 0 repeat, 1 mirrored, 2 clamp, 3 border of 0
const uint texture_wrap_v_shift = 8u;
const uint texture_linear_mag = 1024u;
const uint texture_linear_min = 2048u;
const uint texture_mip_nearest = 4096u;
const uint texture_mip_linear = 8192u;
const uint texture_anisotropy_shift = 14u;  // 5 bits: 0 or 1: none

struct SceneLight {
  vec3 position;   // relative to the origin, m
  vec3 direction;  // unit, the way it travels
  vec3 intensity;  // linear RGB: lx or cd
  float inverse_range;  // 1/m, 0 for infinite
  float angle_scale;    // KHR_lights_punctual, spot
  float angle_offset;
  uint kind;  // light_*
};
REF_TYPE(SceneLight, 4)

const uint light_directional = 0u;
const uint light_point = 1u;
const uint light_spot = 2u;

// What all draws of a frame share, and what is read so often that it goes with each of them. As push
// constants, which may be 128 bytes: 4 are left.
struct SceneArgs {
  REF(SceneDraw) draws;
  REF(SceneMaterial) materials;
  REF(SceneTexture) textures;
  REF(SceneLight) lights;
  REF(float) linear_from_srgb;  // of the 256 codes
  REF(uvec2) order;             // blended elements from far to near: draw, first index
  vec3 ambient;   // radiance
  uint light_count;
  vec3 backward;  // to an orthographic camera
  uint orthographic;
  float near;
  float log2_far_over_near;  // logarithmic depth only
  // Factors of the one material that is drawn; not of `order`, where each element has its own.
  float metallic;
  float roughness;
  vec4 base_color;
  vec3 emission;
};
REF_TYPE(SceneArgs, 8)

#ifdef __cplusplus
}
#endif
#endif
