#pragma once

#include <span>

#include "geometry/grid.h"
#include "geometry/math.h"
#include "geometry/scene.h"

namespace parity {

/// An image with its smaller versions, and how it is read.
struct MippedTexture {
  std::span<const Grid<u8vec4>> levels;  ///< borrowed; level 0 first, none empty: mip_pyramid
  bool srgb = false;                     ///< RGB is stored in sRGB
  Sampler sampler;
};

}  // namespace parity
