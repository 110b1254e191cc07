// What the kernels of the shading chapter and their hosts share. Fields only.
#ifndef PARITY_SHADING_LAYOUT_H
#define PARITY_SHADING_LAYOUT_H

#include "../shared.h"

#ifdef __cplusplus
namespace parity {
#endif

/// Models of BrdfQuery.
const uint brdf_lambert = 0u;
const uint brdf_phong = 1u;
const uint brdf_phong_normalized = 2u;
const uint brdf_blinn_phong = 3u;
const uint brdf_blinn_phong_normalized = 4u;
const uint brdf_ggx = 5u;
const uint brdf_beckmann = 6u;
const uint brdf_ggx_multi_scatter = 7u;  ///< GGX and what it loses, by the albedo table
const uint brdf_sheen = 8u;              ///< Charlie
const uint brdf_model_count = 9u;

/// Fresnel terms of the microfacet models.
const uint fresnel_schlick = 0u;     ///< color: reflectance at normal incidence
const uint fresnel_dielectric = 1u;  ///< color: index of refraction, at least 1
const uint fresnel_conductor = 2u;   ///< color, absorption: complex index eta + i k

/// One value of a BRDF. Directions are unit, point away from the surface, and stand in the frame
/// whose z is the normal and whose x is the tangent.
struct BrdfQuery {
  vec3 to_light;
  vec3 to_eye;
  vec3 color;       ///< albedo of the diffuse or specular lobe, or the Fresnel term's number
  vec3 absorption;
  vec2 alpha;       ///< widths of the microfacet distribution along x and y; sheen: x
  float exponent;   ///< of the Phong models
  uint model;       ///< brdf_*
  uint fresnel;     ///< fresnel_*
};
REF_TYPE(BrdfQuery, 4)

/// Side of the table of directional albedos (shading/albedo_table.glsl).
const uint albedo_side = 16u;

struct BrdfArgs {
  REF(BrdfQuery) queries;
  REF(vec4) albedo_table;
  REF(vec3) values;
  uint count;
  uint padding;
};

struct AlbedoTableArgs {
  REF(vec4) table;  ///< albedo_side^2, a row a roughness
  uint samples;     ///< squared: of one entry
  uint padding;
};

/// A triangle that is lit by a point light of 1 W/sr and seen from an eye, at barycentric coordinates.
struct GouraudQuery {
  vec3 corners[3];
  vec3 normals[3];  ///< unit
  vec3 light;
  vec3 eye;
  vec3 place;      ///< barycentric
  float specular;  ///< share of the highlight; the rest is diffuse
  float exponent;
};
REF_TYPE(GouraudQuery, 4)

struct GouraudArgs {
  REF(GouraudQuery) queries;
  REF(vec2) radiances;  ///< interpolated from the corners; shaded with the interpolated normal
  uint count;
  uint padding;
};

/// A rectangle of radiance 1 that shines on a point; seen from both sides.
struct RectangleQuery {
  vec3 corners[4];  ///< in a plane, in order
  vec3 point;
  vec3 normal;  ///< unit
};
REF_TYPE(RectangleQuery, 4)

/// A sphere of radiance 1 that shines on a rough mirror at the origin; z is its normal.
struct SphereQuery {
  vec3 center;
  float radius;
  vec3 to_eye;  ///< unit
  float alpha;
};
REF_TYPE(SphereQuery, 4)

struct RectangleArgs {
  REF(RectangleQuery) queries;
  REF(float) irradiances;
  uint count;
  uint padding;
};

struct SphereArgs {
  REF(SphereQuery) queries;
  REF(float) radiances;
  uint count;
  uint padding;
};

/// A film on a base, for light at one angle.
struct FilmQuery {
  vec3 base;  ///< F0 without the film
  float index;
  float thickness;  ///< nm
  float cosine;
};
REF_TYPE(FilmQuery, 4)

struct FilmArgs {
  REF(FilmQuery) queries;
  REF(vec3) reflectances;
  uint count;
  uint padding;
};

/// Environment maps as levels of octahedral texels, each with a border of one texel.
struct MirrorArgs {
  REF(vec4) source;
  REF(uint) begins;  ///< of the source's levels
  REF(vec4) mirror;  ///< side^2, no border
  uint source_side;  ///< of the largest level
  uint level_count;
  uint side;
  uint samples;
  float roughness;
  uint padding;
};

struct HarmonicsArgs {
  REF(vec4) level;  ///< one level with its border
  REF(vec4) rows;   ///< 9 sums a row; w of the first the solid angle
  REF(vec4) coefficients;
  uint side;
  uint padding;
};

struct IrradianceArgs {
  REF(vec4) level;       ///< one level with its border
  REF(vec4) irradiance;  ///< over pi; side^2, no border
  uint level_side;
  uint side;
};

/// Distances from the eye at which four cascades of shadow maps end, and the maps, one after another.
struct ShadowArgs {
  REF(vec4) points;  ///< world, and the distance along the view
  REF(mat4) shadow_from_world;  ///< x, y of the map from 0 to 1, z depth; affine
  REF(float) depths;
  REF(float) visibilities;
  vec4 ends;
  uint count;
  uint side;
  uint radius;  ///< texels; the filter is 2 radius + 1 wide
  float bias;
};

/// Ambient occlusion of a picture from its distances along the view.
struct OcclusionArgs {
  REF(float) distances;   ///< m, infinity: nothing is there
  REF(vec4) directions;   ///< of the slices, px, x right, y down; weight; one over the length
  REF(float) parts;       ///< of the way to the radius, one a step, ascending to 1
  REF(float) openness;
  vec2 slope;             ///< half of the view's width and height at distance 1 (orthographic: m)
  uint width;
  uint height;
  uint orthographic;
  float radius;           ///< m
  uint slice_count;
  uint steps;
};

/// How scene-referred colours become display-referred ones; numbers of parity::ToneMap.
const uint tone_clamp = 0u;
const uint tone_neutral = 1u;
const uint tone_aces = 2u;
const uint tone_agx = 3u;

struct ToneMapArgs {
  REF(vec4) colors;
  uint count;
  uint tone_map;
  float gain;  ///< of the exposure
  uint padding;
};

#ifdef __cplusplus
}  // namespace parity
#endif
#endif
