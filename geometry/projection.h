#pragma once

#include <cstdint>

namespace parity {

/// How a place in space, or a direction, becomes a place in a texture. The box [-1, 1]^3 fills the
/// texture; (u, v) = (0, 0) is the top left corner, seen from outside.
enum class Projection : std::uint32_t {
  planar,       ///< along z: u = (1 + x) / 2, v = (1 - y) / 2
  cylindrical,  ///< around y: u as spherical, v = (1 - y) / 2
  spherical,    ///< equirectangular: u = 1/2 + atan2(x, -z) / 2 pi, v = angle from +y / pi
  cubic         ///< the face that the direction hits, as Vulkan's cube maps have them
};

}  // namespace parity
