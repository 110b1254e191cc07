#include "cpu_reference/raster/planes.h"

#include <cmath>

namespace parity::cpu {
namespace {

/// A plane over normalised device coordinates as one over pixels.
dvec3 in_pixels(const dvec3& ndc, int width, int height) {
  return {ndc.x * 2.0 / width, ndc.y * 2.0 / height, ndc.z - ndc.x - ndc.y};
}

Planes with_sums(std::array<dvec3, 3> weight, const std::array<vec4, 3>& clip) {
  Planes p;
  p.weight = weight;
  for (std::size_t i = 0; i < 3; ++i) {
    p.one_over_w += weight[i];
    p.depth += weight[i] * double(clip[i].z);
  }
  return p;
}

Planes constant(const std::array<vec4, 3>& clip) {
  const double w = clip[0].w;
  return with_sums({dvec3(0.0, 0.0, 1 / (w != 0 ? w : 1.0)), dvec3(0.0), dvec3(0.0)}, clip);
}

Planes of_triangle(const std::array<vec4, 3>& clip, int width, int height) {
  // Rows of the inverse of the matrix with columns (x, y, w)_i: weight_i = cross of the other two
  // over the determinant.
  const auto row = [&](std::size_t i) {
    return dvec3(double(clip[i].x), double(clip[i].y), double(clip[i].w));
  };
  const dvec3 a = row(0), b = row(1), c = row(2);
  const dvec3 bc = glm::cross(b, c);
  const double determinant = glm::dot(a, bc);
  if (determinant == 0 || !std::isfinite(1 / determinant)) return constant(clip);
  return with_sums({in_pixels(bc / determinant, width, height),
                    in_pixels(glm::cross(c, a) / determinant, width, height),
                    in_pixels(glm::cross(a, b) / determinant, width, height)},
                   clip);
}

Planes of_line(const std::array<vec4, 3>& clip, int width, int height) {
  const ClippedLine line = clip_line(clip[0], clip[1]);
  if (line.empty) return constant(clip);
  const dvec2 a = window_of(line.ends[0], width, height);
  const dvec2 b = window_of(line.ends[1], width, height);
  const dvec2 along = b - a;
  const double squared = glm::dot(along, along);
  if (!(squared > 0)) return constant(clip);
  const dvec3 t{along.x / squared, along.y / squared, -glm::dot(a, along) / squared};
  const dvec3 first = (dvec3(0.0, 0.0, 1.0) - t) / line.ends[0].w;
  const dvec3 second = t / line.ends[1].w;
  return with_sums({first * (1 - line.at[0]) + second * (1 - line.at[1]),
                    first * line.at[0] + second * line.at[1], dvec3(0.0)},
                   clip);
}

}  // namespace

Planes element_planes(const PlacedDraw& draw, std::uint32_t element, int width, int height) {
  const std::array<vec4, 3> clip = clip_corners(draw, element);
  switch (draw.primitive->topology) {
    case Topology::points:
      return constant(clip);
    case Topology::lines:
      return of_line(clip, width, height);
    case Topology::triangles:
      return of_triangle(clip, width, height);
  }
  return {};
}

}  // namespace parity::cpu
