#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geometry/behind.h"
#include "geometry/environment.h"
#include "geometry/scene.h"
#include "geometry/shadow.h"

namespace parity {

/// What to draw a scene with.
struct FrameOptions {
  int width = 1280;
  int height = 720;
  int samples = 1;     ///< 1, 2, 4 or 8 a pixel, at the standard sample places
  std::string camera;  ///< name or index of a camera of the scene; empty: the first, else framed
  DepthMode depth = DepthMode::reverse_z;
  vec4 background{0.0f, 0.0f, 0.0f, 0.0f};  ///< linear RGB and alpha
  /// Radiance of a uniform environment, linear RGB, W/(m^2 sr). None: 0 where the scene has lights,
  /// else enough to see by, together with a key light.
  std::optional<vec3> environment;
  bool key_light = true;  ///< where the scene has no lights
};

/// One primitive in one place.
struct Draw {
  int mesh = 0;
  int primitive = 0;  ///< within the mesh
  int material = -1;
  dmat4 world_from_object{1.0};
  dmat3 world_from_object_normal{1.0};  ///< inverse transpose, unscaled; 0 if singular
  mat4 clip_from_object{1.0f};  ///< the product in double, rounded once: both sides decide with it
  bool mirrored = false;        ///< negative determinant: winding turns over
};

/// A punctual light where it stands.
struct PlacedLight {
  Light light;
  dvec3 position{0.0};   ///< m
  dvec3 direction{0.0};  ///< unit, the way the light travels
};

/// A scene seen through one camera: what both renderers draw, and all that they share.
struct Frame {
  FrameOptions options;
  dmat4 view_from_world{1.0};
  dmat4 clip_from_view{1.0};
  dvec3 eye{0.0};                 ///< m, world; unused if orthographic
  dvec3 backward{0.0, 0.0, 1.0};  ///< unit, world: from the scene to an orthographic camera
  bool orthographic = false;
  double near = 0.1;
  double far = 0.0;         ///< 0: infinite
  std::vector<Draw> draws;  ///< in the order of the scene
  std::vector<PlacedLight> lights;
  vec3 ambient{0.0f};  ///< radiance of the uniform environment, linear RGB, W/(m^2 sr)
  /// Stands in for the uniform one. Both renderers shade with these same numbers.
  std::optional<EnvironmentLight> environment;
  /// What hides lights, at most most_shadows of them; cast_shadows makes them.
  std::vector<LightShadow> shadows;
  /// Share of the light from all around that reaches each place of the picture, of any size, by
  /// ambient occlusion; empty: all. For what is not blended.
  Grid<float> openness;
  /// What is seen through what transmits light; look_behind makes it. None: the surroundings alone,
  /// and, unrefracted, what is blended.
  std::optional<BehindPicture> behind;
};

constexpr std::size_t most_shadows = 8;

/// Places everything. Without a camera: framing_camera. Without a
/// light (and no emission or unlit material to see by): a key light and a uniform environment.
///
/// @throws std::invalid_argument  a size outside 1..16384, samples not 1, 2, 4, 8, no such camera;
///                                logarithmic depth with an orthographic or infinite one.
Frame make_frame(const Scene& scene, const FrameOptions& options);

/// The way that a place of the picture (px, y down) looks, in the world: unit.
dvec3 view_direction(const Frame& frame, dvec2 place);

/// A renderer's answer. Linear RGB, alpha 0 where only background is.
struct Picture {
  Grid<vec4> color;   ///< premultiplied by nothing: what is on top, in W/(m^2 sr)
  Grid<float> depth;  ///< of sample 0, in the convention of the frame
  Grid<std::uint32_t>
      element;  ///< of sample 0: 1 + number of the opaque triangle in front, counted
                ///< through all draws; 0: background. Empty unless asked for.
  std::uint64_t triangle_count = 0;
  std::vector<std::pair<std::string, double>> pass_seconds;
  std::uint64_t memory_bytes = 0;  ///< of buffers and images that the renderer made
};

}  // namespace parity
