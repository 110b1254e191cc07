#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/grid.h"
#include "geometry/math.h"

/// What a picture of a simulation shows, as plain values that both renderers take.
namespace parity {

/// Rays of the picture. (u, v) runs from -1 to 1, v up. Perspective: from the eye along
/// forward + u right + v up. Orthographic: from eye + u right + v up along forward.
struct DrawnView {
  int width = 0;    ///< px
  int height = 0;   ///< px
  int samples = 1;  ///< along each side of a pixel, on a regular grid, averaged in linear light
  bool is_orthographic = false;
  vec3 eye{0};
  vec3 right{1, 0, 0};
  vec3 up{0, 1, 0};
  vec3 forward{0, 0, -1};  ///< unit length

  bool operator==(const DrawnView&) const = default;
};

/// Perspective view of a target; `up` is y.
DrawnView perspective_view(ivec2 size, dvec3 eye, dvec3 target, double fov_degrees);

/// A view along -z of the rectangle from low to high, with a margin so that nothing is stretched.
DrawnView flat_view(ivec2 size, dvec2 low, dvec2 high);

/// A view from the front, the right and above that shows all of the box (0, 0, 0) to size.
DrawnView framing_view(ivec2 picture, dvec3 size, double fov_degrees);

struct DrawnSolid {
  std::uint32_t is_box = 0;        ///< else a sphere: centre low, radius high.x
  std::uint32_t casts_shadow = 1;  ///< 0: edges of the domain
  vec3 low{0};
  vec3 high{0};
  vec3 color{0.5f};
};

/// How the volume is shown.
enum class VolumeMode : std::uint32_t {
  none,
  shadow,  ///< unseen: darkens what lies behind it from the sun and the sky
  smoke,   ///< light scatters in it once
};

/// Cubic cells, x fastest, then y; values at their centres, linear between them.
struct DrawnVolume {
  VolumeMode mode = VolumeMode::none;
  ivec3 size{0};
  vec3 origin{0};             ///< m, lower corner
  float cell = 1;             ///< m
  std::vector<float> values;  ///< extinction, 1/m
};

struct DrawnLight {
  vec3 sun{0.4f, 0.8f, 0.4f};  ///< towards it, unit length
  vec3 sun_color{2.2f, 2.1f, 1.95f};
  vec3 sky_color{0.62f, 0.68f, 0.78f};     ///< on what faces up
  vec3 ground_color{0.32f, 0.31f, 0.30f};  ///< on what faces down
  vec3 horizon{0.80f, 0.83f, 0.86f};
  vec3 zenith{0.42f, 0.55f, 0.72f};
  vec3 floor_color{0.36f, 0.37f, 0.38f};
  float floor_y = 0;            ///< m
  float fade = 10;              ///< m: beyond, the floor is lost in the horizon
  std::uint32_t has_floor = 1;  ///< 0: the horizon's colour everywhere
  vec3 medium{0.9f};            ///< albedo of smoke
  float forward_scatter = 0;    ///< g of Henyey & Greenstein
};

struct DrawnScene {
  DrawnView view;
  DrawnLight light;
  std::vector<vec3> positions;  ///< of particles, m
  std::vector<vec3> colors;     ///< of particles, linear
  float radius = 0;             ///< of particles, m
  DrawnVolume volume;
  std::vector<DrawnSolid> solids;  ///< at most 64
};

/// @throws std::invalid_argument  a size outside 1..8192 px or 1..4 samples; counts that differ; a
///                                volume without cells, or of other counts; more than 64 solids; a
///                                particle or a value that is not finite.
void check_drawn_scene(const DrawnScene& scene);

/// A field in 2 dimensions: colours by value, streaks along the flow.
struct DrawnField {
  ivec2 cells{0};
  std::vector<vec2> velocity;   ///< at cell centres, row 0 at the bottom; any unit
  std::vector<float> value;     ///< 0 to 1 along the colour map
  std::vector<float> solid;     ///< 0 to 1
  std::vector<vec3> color_map;  ///< linear, at least 2, evenly spaced
  Grid<float> noise;            ///< 0 to 1, one texel for every `noise_scale` px, repeated
  float noise_scale = 1.5f;     ///< px
  int streak = 20;              ///< px to either side along the flow, 0..64
  float contrast = 0.5f;        ///< of the streaks
  float slowest = 1e-3f;        ///< > 0; slower flow leaves shorter streaks
  vec3 solid_color{0.16f};
  int width = 0;  ///< px
  int height = 0;
};

/// @throws std::invalid_argument  as check_drawn_scene.
void check_drawn_field(const DrawnField& field);

}  // namespace parity
