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
/// footprints of its triangles: a few more than are, never fewer. All levels where that is in
/// doubt: of alpha masks (shadow maps read them from elsewhere too), of what is nearer than the
/// near plane, of triangles too slender to tell.
///
/// A footprint is at least as long as two rays a pixel apart are apart at the nearest corner, and
/// its minor half axis too where the distance hardly changes within a pixel, else an eighth (or
/// whatever the sampler follows) of it. It is at most the norm of the homography's derivative,
/// which is largest at a corner.
///
/// @param frame  moved by up to a pixel it reads no other levels.
/// @return       one an image, levels counted from 0, the full size.
///
/// Source: Vulkan 1.3, "Scale Factor Operation, Level-of-Detail"; Heckbert 1989 (derivatives).
std::vector<LevelRange> read_levels(const Scene& scene, const Frame& frame);

}  // namespace parity
