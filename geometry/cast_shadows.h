#pragma once

#include <functional>

#include "geometry/frame.h"

namespace parity {

struct ShadowOptions {
  int side = 1024;  ///< texels of a map, 16 to 8192
  int radius = 1;   ///< texels, 0 to 8: the filter is 2 radius + 1 wide
};

/// Draws the shadow maps of a frame's lights, the first most_shadows of them. A directional light
/// has as many cascades as the view of the scene is deep, up to 4; a spot light reaches to the
/// sides of its cone, at most 80 degrees from its axis; a point light has a cube of maps of half
/// the side. What is blended casts no shadow, nor does the back of what is single-sided.
///
/// @param depths_of  renders a frame and returns its depths.
/// @throws std::invalid_argument  options out of range.
///
/// Source: notes 6.1; Williams 1978; Zhang et al. 2006 (cascades); Holbert 2011 (receivers moved
/// along their normals).
std::vector<LightShadow> cast_shadows(const Scene& scene, const Frame& frame,
                                      const ShadowOptions& options,
                                      const std::function<Grid<float>(const Frame&)>& depths_of);

}  // namespace parity
