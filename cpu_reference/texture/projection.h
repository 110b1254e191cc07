#pragma once

#include "geometry/math.h"
#include "geometry/projection.h"

namespace parity::cpu {

/// A place in a texture; `face` of cubic projections: +x -x +y -y +z -z, else 0.
struct TexturePoint {
  dvec2 uv{0.0};
  int face = 0;
};

/// @param p  not 0, except for planar and cylindrical projection.
///
/// Source: notes 6.3; Vulkan 1.3, "Cube Map Face Selection", "Cube Map Coordinate Transformation".
TexturePoint project(Projection projection, dvec3 p);

/// The unit direction that spherical or cubic projection takes to a place: the inverse of
/// `project`.
dvec3 direction_of(Projection projection, TexturePoint place);

/// Shares of the three planar projections along x, y and z for a surface of normal n: |n_i|^4 over
/// their sum, so that none shows where it is stretched.
///
/// Source: Geiss 2007, GPU Gems 3, 1.5. Differs: power 4 instead of a threshold.
dvec3 triplanar_weights(dvec3 normal);

}  // namespace parity::cpu
