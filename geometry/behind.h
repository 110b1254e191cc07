#pragma once

#include <vector>

#include "geometry/grid.h"
#include "geometry/math.h"

namespace parity {

/// A picture of what is opaque, for what light passes through.
struct BehindPicture {
  /// Premultiplied linear colours, from the full size down to one texel; each side of a level is
  /// half of that above, rounded down. A texel is the mean of what it covers.
  std::vector<Grid<vec4>> levels;
  dmat4 clip_from_world{1.0};
};

/// Averages a picture again and again. Sides of an odd number of texels share theirs by area.
std::vector<Grid<vec4>> picture_levels(const Grid<vec4>& picture);

}  // namespace parity
