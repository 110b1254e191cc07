#include "geometry/jitter.h"

namespace parity {

Frame shifted(const Frame& frame, dvec2 pixels) {
  Frame result = frame;
  shift_into(result, frame, pixels);
  return result;
}

void shift_into(Frame& copy, const Frame& frame, dvec2 pixels) {
  // Clip x gains shift w: two clip units are the picture's width. Clip y points down.
  dmat4 shift{1.0};
  shift[3][0] = 2 * pixels.x / frame.options.width;
  shift[3][1] = 2 * pixels.y / frame.options.height;
  copy.clip_from_view = shift * frame.clip_from_view;
  const dmat4 clip_from_world = copy.clip_from_view * frame.view_from_world;
  for (Draw& draw : copy.draws)
    draw.clip_from_object = mat4(clip_from_world * draw.world_from_object);
}

}  // namespace parity
