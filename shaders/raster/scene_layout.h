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
  float scale;  // cube root of the volume of an object's unit cube
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
const uint draw_flag_bits = 5u;   // so many are read where pixels are shaded
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
const uint material_flag_blend = 2u;  // is drawn over what is behind
const uint material_flag_double_sided = 4u;
const uint material_flag_unlit = 8u;
const uint material_flag_alpha = 16u;  // base colours have alpha

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

const uint texture_role_mask = 31u;  // what it is for, parity::TextureRole:
const uint texture_base_color = 0u;
const uint texture_metallic_roughness = 1u;
const uint texture_normal = 2u;
const uint texture_occlusion = 3u;
const uint texture_emission = 4u;
const uint texture_specular = 5u;
const uint texture_specular_color = 6u;
const uint texture_clearcoat = 7u;
const uint texture_clearcoat_roughness = 8u;
const uint texture_clearcoat_normal = 9u;
const uint texture_sheen_color = 10u;
const uint texture_sheen_roughness = 11u;
const uint texture_anisotropy = 12u;
const uint texture_iridescence = 13u;
const uint texture_iridescence_thickness = 14u;
const uint texture_transmission = 15u;
const uint texture_thickness = 16u;
const uint texture_slot_shift = 5u;  // 3 bits: the slot of its uv
const uint texture_wrap_u_shift = 8u;  // 2 bits: 0 repeat, 1 mirrored, 2 clamp, 3 border of 0
const uint texture_wrap_v_shift = 10u;
const uint texture_linear_mag = 4096u;
const uint texture_linear_min = 8192u;
const uint texture_mip_nearest = 16384u;
const uint texture_mip_linear = 32768u;
const uint texture_anisotropy_shift = 16u;  // 5 bits: 0 or 1: none
const uint texture_first_level_shift = 21u;  // 4 bits: finer ones are not there
const uint texture_last_level_shift = 25u;   // 4 bits: 15 less the last one that is there
const uint texture_mirror_once_u = 1u << 29;  // then wrapped as is said
const uint texture_mirror_once_v = 1u << 30;

struct SceneLight {
  vec3 position;   // relative to the origin, m
  vec3 direction;  // unit, the way it travels
  vec3 intensity;  // linear RGB: lx or cd
  float inverse_range;  // 1/m, 0 for infinite
  float angle_scale;    // KHR_lights_punctual, spot
  float angle_offset;
  uint kind;    // light_*
  uint shadow;  // 1 + its number; 0: nothing hides it
};
REF_TYPE(SceneLight, 4)

const uint light_directional = 0u;
const uint light_point = 1u;
const uint light_spot = 2u;

// What the extensions of a material add.
struct SceneLayers {
  vec3 specular_color;  // reflectance of the border of the index times specularColorFactor
  float specular;
  float clearcoat;
  float clearcoat_roughness;
  float clearcoat_normal_scale;
  float sheen_roughness;
  vec3 sheen_color;
  float anisotropy;
  vec2 anisotropy_direction;  // cosine and sine of the rotation
  float index;
  float transmission;
  float thickness;  // m; 0: a thin wall
  vec3 log2_attenuation;  // 1/m
  uint has_coat_normal;
  float iridescence;
  float film_index;
  vec2 film_thickness;  // least and most, nm
};
REF_TYPE(SceneLayers, 4)

const uint mirror_level_count = 7u;

// Light from all around: parity::EnvironmentLight.
struct SceneEnvironment {
  REF(vec4) mirrors;     // level after level, each with a border
  REF(vec4) irradiance;  // one level with its border, or none
  uint begins[mirror_level_count];
  uint sides[mirror_level_count];  // without borders
  uint irradiance_side;            // 0: harmonics
  vec3 harmonics[9];
};
REF_TYPE(SceneEnvironment, 8)

// What hides a light: parity::LightShadow.
struct SceneShadow {
  mat4 shadow_from_position[6];  // x, y of the map 0 to 1, z depth, times w
  vec4 ends;                     // distances along the view
  float lifts[6];                // m where w is 1
  vec3 forward;
  float offset;
  vec3 center;   // of a cube of maps: the light, relative to the origin
  uint is_cube;  // maps look along +x, -x, +y, -y, +z, -z
  REF(float) depths;  // map after map
  uint side;
  uint radius;
  float bias;
  uint padding;
};
REF_TYPE(SceneShadow, 8)

// What pictures of the frame, made before, say about its places.
struct SceneScreen {
  REF(float) openness;  // how much of the sky is over each place
  REF(vec4) behind;     // what is opaque, premultiplied, level after level
  mat4 clip_from_position;
  uvec2 size;  // of the frame, px
  uvec2 openness_size;
  uvec2 behind_size;  // of the first level
  uint behind_levels;
  uint padding;
  uint behind_begins[16];
};
REF_TYPE(SceneScreen, 8)

// What all draws of a frame share, as push constants, which may be 128 bytes: none is left. For a draw
// that is not of `order`, `draws`, `materials` and `layers` begin with its own: reading what has one
// address for all fragments is far cheaper than reading where each of them says.
struct SceneArgs {
  REF(SceneDraw) draws;
  REF(SceneMaterial) materials;
  REF(SceneTexture) textures;
  REF(SceneLight) lights;
  REF(float) linear_from_srgb;  // of the 256 codes
  REF(SceneLayers) layers;      // as materials, if any has some
  REF(SceneEnvironment) environment;
  REF(vec4) albedo_table;
  vec3 ambient;   // radiance
  uint light_count;
  vec3 backward;  // to an orthographic camera
  uint orthographic;
  float near;
  float log2_far_over_near;  // logarithmic depth only
  REF(uvec2) order;             // blended elements from far to near: draw, first index
  REF(SceneShadow) shadows;
  REF(SceneScreen) screen;
};
REF_TYPE(SceneArgs, 8)

#ifdef __cplusplus
}
#endif
#endif
