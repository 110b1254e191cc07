#include "cpu_reference/raster/clip.h"

#include <limits>
#include <stdexcept>
#include <string>

#include "cpu_reference/raster/triangle_list.h"

namespace parity::cpu {
namespace {

/// Inside where dot(normal, position) >= offset.
struct Plane {
  dvec4 normal;
  double offset = 0.0;
};

std::array<Plane, 7> view_planes(double g) {
  const double smallest = std::numeric_limits<float>::min();
  return {Plane{{0, 0, 0, 1}, smallest}, Plane{{0, 0, 1, 0}},  Plane{{0, 0, -1, 1}},
          Plane{{1, 0, 0, g}},           Plane{{-1, 0, 0, g}}, Plane{{0, 1, 0, g}},
          Plane{{0, -1, 0, g}}};
}

double distance(const Plane& plane, const dvec4& position) {
  return glm::dot(plane.normal, position) - plane.offset;
}

/// Rounding can bend a polygon without width so that a plane cuts it more than twice; what is then
/// too much has no area and is left out.
void append(ClippedPolygon& polygon, dvec4 position, dvec3 barycentric) {
  if (polygon.count == polygon.position.size()) return;
  polygon.position[polygon.count] = position;
  polygon.barycentric[polygon.count] = barycentric;
  ++polygon.count;
}

/// The point on the edge between corners `in` and `out`, on either side of the plane.
void append_crossing(ClippedPolygon& to, const ClippedPolygon& from, std::uint32_t in,
                     std::uint32_t out, const Plane& plane) {
  const double inside = distance(plane, from.position[in]);
  const double outside = distance(plane, from.position[out]);
  const double t = inside / (inside - outside);
  append(to, from.position[in] + t * (from.position[out] - from.position[in]),
         from.barycentric[in] + t * (from.barycentric[out] - from.barycentric[in]));
}

ClippedPolygon cut(const ClippedPolygon& polygon, const Plane& plane) {
  ClippedPolygon kept;
  for (std::uint32_t i = 0; i < polygon.count; ++i) {
    const std::uint32_t next = (i + 1) % polygon.count;
    const bool is_inside = distance(plane, polygon.position[i]) >= 0.0;
    const bool next_is_inside = distance(plane, polygon.position[next]) >= 0.0;
    if (is_inside) append(kept, polygon.position[i], polygon.barycentric[i]);
    if (is_inside && !next_is_inside) append_crossing(kept, polygon, i, next, plane);
    if (!is_inside && next_is_inside) append_crossing(kept, polygon, next, i, plane);
  }
  return kept;
}

bool is_finite(const std::array<dvec4, 3>& corners) {
  for (const dvec4& corner : corners)
    if (!glm::all(glm::lessThan(glm::abs(corner), dvec4(std::numeric_limits<double>::infinity()))))
      return false;
  return true;
}

}  // namespace

ClippedPolygon clip_triangle(const std::array<dvec4, 3>& corners, double guard_band) {
  ClippedPolygon polygon;
  if (!is_finite(corners)) return polygon;
  for (int i = 0; i < 3; ++i) {
    dvec3 barycentric{0.0};
    barycentric[i] = 1.0;
    append(polygon, corners[std::size_t(i)], barycentric);
  }
  for (const Plane& plane : view_planes(guard_band)) polygon = cut(polygon, plane);
  return polygon;
}

std::vector<ClippedPolygon> clip(const TriangleList& list, double guard_band) {
  if (!(guard_band >= 1.0))
    throw std::invalid_argument("cpu::clip: guard band is " + std::to_string(guard_band) +
                                ", must be >= 1");
  check_triangles(list);
  std::vector<ClippedPolygon> polygons;
  polygons.reserve(list.triangles.size());
  for (const uvec3& triangle : list.triangles)
    polygons.push_back(clip_triangle(
        {dvec4(list.clip_positions[triangle.x]), dvec4(list.clip_positions[triangle.y]),
         dvec4(list.clip_positions[triangle.z])},
        guard_band));
  return polygons;
}

}  // namespace parity::cpu
