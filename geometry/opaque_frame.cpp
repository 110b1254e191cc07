#include "geometry/opaque_frame.h"

#include <algorithm>

namespace parity {
namespace {

bool transmits(const Scene& scene, const Draw& draw) {
  return draw.material >= 0 && is_transmissive(scene.materials[std::size_t(draw.material)]);
}

bool is_opaque(const Scene& scene, const Draw& draw) {
  return draw.material < 0 ||
         (!transmits(scene, draw) && !is_blended(scene.materials[std::size_t(draw.material)]));
}

/// The rows of x and y stay: they may be shifted.
dmat4 with_depth(const Frame& frame, DepthMode depth) {
  Camera camera;
  camera.orthographic = frame.orthographic;
  camera.near = frame.near;
  if (frame.far > 0) camera.far = frame.far;
  const dmat4 row = clip_from_view(camera, 1, depth);
  dmat4 clip = frame.clip_from_view;
  clip[2][2] = row[2][2];
  clip[3][2] = row[3][2];
  return clip;
}

}  // namespace

Frame opaque_frame(const Scene& scene, const Frame& frame, DepthMode depth) {
  Frame result = frame;
  result.options.samples = 1;
  result.options.depth = depth;
  result.clip_from_view = with_depth(frame, depth);
  result.draws.clear();
  const dmat4 clip_from_world = result.clip_from_view * frame.view_from_world;
  for (Draw draw : frame.draws) {
    if (!is_opaque(scene, draw)) continue;
    draw.clip_from_object = mat4(clip_from_world * draw.world_from_object);
    result.draws.push_back(draw);
  }
  return result;
}

std::optional<BehindPicture> look_behind(const Scene& scene, const Frame& frame,
                                         const std::function<Grid<vec4>(const Frame&)>& colors_of) {
  if (std::ranges::none_of(frame.draws, [&](const Draw& draw) { return transmits(scene, draw); }))
    return std::nullopt;
  Frame opaque = opaque_frame(scene, frame, frame.options.depth);
  opaque.options.samples = frame.options.samples;
  opaque.behind.reset();
  return BehindPicture{picture_levels(colors_of(opaque)),
                       frame.clip_from_view * frame.view_from_world};
}

}  // namespace parity
