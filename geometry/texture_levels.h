#pragma once

#include <vector>

#include "geometry/frame.h"

namespace parity {

/// Which levels of an image's mip pyramid are read: none if `least` is above `greatest`.
struct LevelRange {
  int least = 99;
  int greatest = -1;
  bool empty() const { return least > greatest; }
  void join(const LevelRange& other);
};

/// The levels of each image of a scene that any pixel of a frame may read, by bounds of the
/// footprints of its triangles (footprint_bounds): a few more than are, never fewer. All levels of
/// alpha masks (shadow maps read them from elsewhere too), of lines and of points; the full size of
/// what has no or constant texture coordinates, for there a sampler magnifies.
///
/// Devices are taken to interpolate what their vertices say once these are on a grid of 1/256 px
/// (subPixelPrecisionBits of 8); what is more than that off may read the nearest level that is
/// kept.
///
/// @param moves  the frame may be moved by up to a pixel: what is between the samples counts too.
/// @return       one an image, levels counted from 0, the full size.
///
/// Source: Vulkan 1.3, "Scale Factor Operation, Level-of-Detail".
std::vector<LevelRange> read_levels(const Scene& scene, const Frame& frame, bool moves = false);

/// What either reads, image by image.
void join(std::vector<LevelRange>& levels, const std::vector<LevelRange>& others);

}  // namespace parity
