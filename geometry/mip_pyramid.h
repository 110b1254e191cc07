#pragma once

#include <cstddef>
#include <vector>

namespace parity {

/// One level of a mip pyramid, and where it begins when the levels are stored one after another.
struct MipLevel {
  int width = 1;
  int height = 1;
  std::size_t first = 0;  ///< texels before it
};

/// Levels 0..n of an image, down to 1x1; sides of level k + 1 are max(1, floor(side / 2)).
///
/// @throws std::invalid_argument  a side is less than 1.
///
/// Source: Vulkan 1.3, "Image Mip Level Sizing".
std::vector<MipLevel> mip_levels(int width, int height);

}  // namespace parity
