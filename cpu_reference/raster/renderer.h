#pragma once

#include <cstdint>
#include <functional>

#include "cpu_reference/raster/surface_bound.h"
#include "geometry/frame.h"
#include "geometry/raster.h"
#include "geometry/scene.h"

namespace parity::cpu {

struct RenderOptions {
  Snapping snapping = Snapping::mesa;  ///< of the device to compare with
  bool elements = false;               ///< fill Picture::element
  bool colors = true;                  ///< else only depths are right, of what is not blended
  bool bounds = false;                 ///< also say how far a right device may be
  DeviceLimits device;                 ///< what the bounds grant it
};

/// A picture and, if asked for, how far a right device may be from it.
struct Rendered {
  Picture picture;
  Grid<vec4> color_bound;        ///< largest right deviation of each channel
  Grid<float> depth_bound;       ///< of Picture::depth
  Grid<std::uint8_t> ambiguous;  ///< 1: a decision is within its error, no colour can be demanded
};

/// Renders a frame by the reference alone: rasterises, shades each pixel of a triangle once,
/// blends.
///
/// Bands of rows are drawn in parallel; every pixel belongs to one, so that the answer does not
/// depend on the number of threads.
///
/// @param scene     what `frame` was made of; materials, indices and images checked by the loader.
/// @param progress  called with the finished part, 0 to 1, never decreasing; may be empty.
/// @throws std::invalid_argument  a size or sample count out of range, more than 2^31 - 1 elements,
///                                logarithmic depth without near > 0 and a finite far plane.
///
/// Source: notes 1.1-1.7, 6.1, 6.3; glTF 2.0, 3.9; Vulkan 1.3, "Rasterization".
Rendered render(const Scene& scene, const Frame& frame, const RenderOptions& options = {},
                const std::function<void(double)>& progress = {});

}  // namespace parity::cpu
