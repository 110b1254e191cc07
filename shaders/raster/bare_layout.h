// What raster/bare.vert and .frag read.
#ifndef PARITY_RASTER_BARE_LAYOUT_H
#define PARITY_RASTER_BARE_LAYOUT_H
#include "../shared.h"

#ifdef __cplusplus
namespace parity {
#endif

struct BareArgs {
  mat4 clip_from_object;
  REF(vec3) positions;
  REF(vec3) normals;
  vec3 eye;
  float ambient;   // radiance, of any channel
  vec3 to_light;   // unit
  float irradiance;  // of a surface that faces the light
  float base_color;  // of any channel
  float roughness;
  REF(vec4) albedo_table;
};
REF_TYPE(BareArgs, 8)

#ifdef __cplusplus
}
#endif
#endif
