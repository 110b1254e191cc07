#pragma once

#include <functional>
#include <optional>

#include "geometry/frame.h"

namespace parity {

/// The same view of what neither is blended nor transmits light, with other depths and one sample a
/// pixel.
Frame opaque_frame(const Scene& scene, const Frame& frame, DepthMode depth);

/// Draws Frame::behind: what is opaque, without what transmits light and what is blended. None if
/// nothing of the frame transmits.
///
/// @param colors_of  renders a frame and returns its colours, premultiplied.
std::optional<BehindPicture> look_behind(const Scene& scene, const Frame& frame,
                                         const std::function<Grid<vec4>(const Frame&)>& colors_of);

}  // namespace parity
