#pragma once

#include <optional>
#include <string>

#include "geometry/math.h"

namespace parity {

/// Depth conventions of the depth buffer; D32F in all cases.
enum class DepthMode {
  standard,     ///< near 0, far 1, LESS
  reverse_z,    ///< near 1, far 0, GREATER, clear 0
  logarithmic,  ///< log2(w / near) / log2(far / near) written by the fragment, LESS
};

/// A camera of a scene; looks along -z of its node, y up.
struct Camera {
  std::string name;
  bool orthographic = false;
  double vertical_fov = 0.7853981633974483;  ///< rad, perspective, in (0, pi)
  std::optional<double> aspect;              ///< width / height; none: that of the picture
  double x_magnification = 1.0;              ///< half width of the view in m, orthographic
  double y_magnification = 1.0;              ///< half height of the view in m, orthographic
  double near = 0.1;                         ///< m, > 0 for perspective
  std::optional<double> far;                 ///< m, > near; none: infinite (perspective only)
};

/// Clip from view for Vulkan: x right, y DOWN, depth 0 to 1 (reverse-Z: 1 to 0). The only place
/// where y turns over.
///
/// @param aspect  width / height of the picture. Where the camera names another, the view grows on
///                one axis: nothing is stretched, nothing that the camera shows is cut off.
/// @throws std::invalid_argument  a parameter outside its range.
///
/// Source: notes 2.6; Vulkan 1.3, "Coordinate Transformations".
dmat4 clip_from_view(const Camera& camera, double aspect, DepthMode depth);

}  // namespace parity
