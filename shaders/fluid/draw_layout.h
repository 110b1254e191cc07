// What the kernels that draw simulations share with their host. Fields only.
#ifndef PARITY_FLUID_DRAW_LAYOUT_H
#define PARITY_FLUID_DRAW_LAYOUT_H

#include "../shared.h"

#ifdef __cplusplus
namespace parity {
#endif

/// A cell of the volume, ready to be marched through.
struct DrawCell {
  float value;
  float sun;  ///< part of the sun's light that the volume lets through to here
  float sky;  ///< part of the sky's
  float lit;  ///< 0: a solid stands before the sun
};
REF_TYPE(DrawCell, 4)

/// See DrawnSolid.
struct DrawSolid {
  uint is_box;
  uint casts_shadow;
  vec3 low;
  vec3 high;
  vec3 color;
};
REF_TYPE(DrawSolid, 4)

/// See DrawnScene. Sizes are in samples.
struct DrawScene {
  REF(vec3) positions;
  REF(vec3) colors;
  REF(float) values;
  REF(DrawCell) cells;
  REF(DrawSolid) solids;
  REF(uint) depths;   ///< bits of the distance of the nearest particle; all ones: none
  REF(uint) nearest;  ///< that particle
  uint width;
  uint height;
  uint is_orthographic;
  vec3 eye;
  vec3 right;
  vec3 up;
  vec3 forward;
  uint particle_count;
  float radius;
  uint solid_count;
  uint mode;
  ivec3 volume_size;
  vec3 volume_origin;
  float cell;
  vec3 sun;
  vec3 sun_color;
  vec3 sky_color;
  vec3 ground_color;
  vec3 horizon;
  vec3 zenith;
  vec3 floor_color;
  float floor_y;
  float fade;
  uint has_floor;
  vec3 medium;
  float forward_scatter;
};
REF_TYPE(DrawScene, 8)

struct DrawSceneArgs {
  REF(DrawScene) scene;
};

/// One layer of cells of the same y takes its light from the layer above.
struct DrawLightArgs {
  REF(DrawScene) scene;
  REF(float) above;  ///< 6 directions x cells of the layer
  REF(float) here;
  uint row;
  uint padding;
};

struct DrawPictureArgs {
  REF(DrawScene) scene;
  REF(vec4) picture;  ///< width / samples x height / samples, linear
  uint samples;
  uint padding;
};

/// See DrawnField.
struct DrawFieldArgs {
  REF(vec2) velocity;
  REF(vec2) value_and_solid;
  REF(vec3) color_map;
  REF(float) noise;
  REF(vec4) picture;
  ivec2 cells;
  ivec2 noise_size;
  uint width;
  uint height;
  uint color_count;
  int streak;
  float noise_scale;
  float contrast;
  float slowest;  ///< speed that is added before directions are normalised
  vec3 solid_color;
};

#ifdef __cplusplus
}  // namespace parity
#endif
#endif
