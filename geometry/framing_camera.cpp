#include "geometry/framing_camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace parity {
namespace {

/// Twice the area of the triangles of a primitive, each foreshortened, whose front the eye sees.
double front_area(const Primitive& primitive, bool double_sided, const dmat4& world, dvec3 eye) {
  const double turn = glm::determinant(dmat3(world)) < 0 ? -1 : 1;
  const auto place = [&](std::size_t index) {
    return dvec3(world * dvec4(dvec3(primitive.positions[primitive.indices[index]]), 1));
  };
  double area = 0;
  for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
    const dvec3 a = place(i), b = place(i + 1), c = place(i + 2);
    const double facing =
        turn * glm::dot(glm::cross(b - a, c - a), glm::normalize(eye - (a + b + c) / 3.0));
    area += double_sided ? std::abs(facing) : std::max(facing, 0.0);
  }
  return area;
}

/// The same of all triangles; infinite if there is a point or a line, which has no back.
double front_area(const Scene& scene, const std::vector<dmat4>& world, dvec3 eye) {
  double area = 0;
  for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
    if (scene.nodes[n].mesh < 0) continue;
    for (const Primitive& p : scene.meshes[std::size_t(scene.nodes[n].mesh)].primitives) {
      if (p.topology != Topology::triangles) return std::numeric_limits<double>::infinity();
      const bool double_sided =
          p.material >= 0 && scene.materials[std::size_t(p.material)].double_sided;
      area += front_area(p, double_sided, world[n], eye);
    }
  }
  return area;
}

/// Where to look from: a unit vector. The usual side if any front is seen from there, else that of
/// 24 from which clearly the most is.
dvec3 viewing_side(const Scene& scene, const std::vector<dmat4>& world, dvec3 middle,
                   double distance) {
  const dvec3 usual{0.45, 0.35, 1.0};
  dvec3 best = glm::normalize(usual);
  double most = front_area(scene, world, middle + distance * best);
  if (most > 0) return best;
  for (const dvec3& turned :
       {usual, dvec3(usual.z, usual.y, usual.x), dvec3(usual.x, usual.z, usual.y)})
    for (int side = 0; side < 8; ++side) {
      const dvec3 signs{side & 1 ? -1 : 1, side & 2 ? -1 : 1, side & 4 ? -1 : 1};
      const dvec3 direction = glm::normalize(signs * turned);
      const double area = front_area(scene, world, middle + distance * direction);
      if (area > 1.000001 * most) most = area, best = direction;
    }
  return best;
}

}  // namespace

PlacedCamera framing_camera(const Scene& scene, const std::vector<dmat4>& world_from_nodes,
                            double aspect) {
  const Bounds bounds = world_bounds(scene);
  const dvec3 middle = bounds.empty ? dvec3(0.0) : 0.5 * (bounds.min + bounds.max);
  double radius = 0.5 * glm::length(bounds.max - bounds.min);
  if (!(radius > 1e-30) || !std::isfinite(radius)) radius = 1;
  Camera camera;
  camera.name = "framed";
  camera.vertical_fov = std::numbers::pi / 6;
  const double narrow =
      std::min(camera.vertical_fov, 2 * std::atan(std::tan(camera.vertical_fov / 2) * aspect));
  const double distance = 1.05 * radius / std::sin(narrow / 2);
  camera.near = std::max(distance - 1.5 * radius, 1e-3 * distance);
  camera.far = distance + 1.5 * radius;
  const dvec3 backward = viewing_side(scene, world_from_nodes, middle, distance);
  const dvec3 right = glm::normalize(glm::cross(dvec3(0, 1, 0), backward));
  const dvec3 up = glm::cross(backward, right);
  return {camera, dmat4(dvec4(right, 0), dvec4(up, 0), dvec4(backward, 0),
                        dvec4(middle + distance * backward, 1))};
}

}  // namespace parity
