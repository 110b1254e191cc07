// What the kernel of punctual lights and its host share. Fields only.
#ifndef PARITY_RASTER_LIGHT_LAYOUT_H
#define PARITY_RASTER_LIGHT_LAYOUT_H

#include "scene_layout.h"

#ifdef __cplusplus
namespace parity {
#endif

struct PunctualLightArgs {
  REF(SceneLight) lights;
  REF(vec3) points;   ///< one a light
  REF(vec4) results;  ///< the way to the light; irradiance of red on what faces it
  uint count;
  uint padding;
};

#ifdef __cplusplus
}  // namespace parity
#endif
#endif
