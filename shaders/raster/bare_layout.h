// What raster/bare.vert and .frag read.
#ifndef PARITY_RASTER_BARE_LAYOUT_H
#define PARITY_RASTER_BARE_LAYOUT_H
#include "../shared.h"

#ifdef __cplusplus
namespace parity {
#endif

struct BareMaterial {
  vec3 base_color;
  vec3 ambient;     // radiance from all around
  vec3 irradiance;  // of a surface that faces the light
};
REF_TYPE(BareMaterial, 4)

struct BareArgs {
  mat4 clip_from_object;
  REF(vec3) positions;
  REF(vec3) normals;
  REF(BareMaterial) material;
  REF(vec4) albedo_table;
  vec3 eye;
  float roughness;
  vec3 to_light;  // unit
  float padding;
};
REF_TYPE(BareArgs, 8)

#ifdef __cplusplus
}
#endif
#endif
