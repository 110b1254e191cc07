#pragma once

#include <vector>

#include "geometry/grid.h"
#include "geometry/math.h"

namespace parity {

/// A corner of a triangle that is to be displaced.
struct DisplacementCorner {
  vec3 position{0.0f};
  vec3 normal{0.0f};
  vec2 uv{0.0f};
};

/// Triangles whose points move along their normals by scale * R / 255 of a height map, as finely
/// cut as a picture needs.
struct DisplacementProblem {
  std::vector<DisplacementCorner> corners;  ///< three a triangle; shared ones are equal
  Grid<u8vec4> heights;                     ///< R; repeated
  float scale = 0;                          ///< m
  mat4 clip_from_world{1.0f};
  ivec2 size{1, 1};      ///< of the picture, px
  float max_pixels = 1;  ///< how far a displaced edge may be from its straight pieces
};

struct DisplacedMesh {
  std::vector<uvec4> factors;  ///< parts of the edges opposite corners 0, 1, 2 and of the inside
  std::vector<vec3>
      corners;  ///< three a small triangle, triangle after triangle; rows from corner 0
};

}  // namespace parity
