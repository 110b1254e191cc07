#pragma once

#include <array>

#include "cpu_reference/raster/elements.h"
#include "geometry/math.h"

namespace parity::cpu {

/// An element's functions of the window, each affine: value = dot(plane, (x, y, 1)), x and y in
/// pixels. weight[i] is the plane of beta_i / w, where beta_i are the perspective-correct
/// barycentric coordinates of the vertices; so any varying is
/// sum(a_i weight[i]) / sum(weight[i]), and window depth is affine. They hold on the element's
/// whole plane: outside of it, and for triangles that reach behind the eye, without clipping.
///
/// Source: Olano & Greer 1997, "Triangle scan conversion using 2D homogeneous coordinates".
struct Planes {
  std::array<dvec3, 3> weight{};
  dvec3 one_over_w{0.0};
  dvec3 depth{0.0};
};

/// A triangle seen edge-on gives the values of its first vertex everywhere. Along a line the
/// varyings change with the projection on it, across it they are constant.
Planes element_planes(const PlacedDraw& draw, std::uint32_t element, int width, int height);

inline double at(const dvec3& plane, double x, double y) {
  return plane.x * x + plane.y * y + plane.z;
}

/// Perspective-correct barycentric coordinates.
inline dvec3 barycentric(const Planes& p, double x, double y) {
  const double scale = 1 / at(p.one_over_w, x, y);
  return {at(p.weight[0], x, y) * scale, at(p.weight[1], x, y) * scale,
          at(p.weight[2], x, y) * scale};
}

}  // namespace parity::cpu
