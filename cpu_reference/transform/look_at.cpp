#include "cpu_reference/transform/look_at.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace parity::cpu {
namespace {

dmat4 view_from_world(const LookAt& camera) {
  const dvec3 eye{camera.eye};
  const dvec3 gaze = dvec3(camera.center) - eye;
  const double distance = glm::length(gaze);
  if (!(distance > 0.0) || !std::isfinite(distance))
    throw std::invalid_argument("cpu::look_at: eye and center are " + std::to_string(distance) +
                                " m apart, must be finite and > 0");
  const dvec3 g = gaze / distance;
  const dvec3 up{camera.up};
  const dvec3 right = glm::cross(g, up);
  // The sine of the angle between gaze and up, below float's resolution: no direction is left.
  const double sine = glm::length(right) / glm::length(up);
  if (!(sine > double(std::numeric_limits<float>::epsilon())) || !std::isfinite(sine))
    throw std::invalid_argument("cpu::look_at: the gaze is parallel to up, or up is zero");
  const dvec3 w = glm::normalize(right);
  const dvec3 t = glm::cross(w, g);
  const dmat4 rows{dvec4(w, -glm::dot(w, eye)), dvec4(t, -glm::dot(t, eye)),
                   dvec4(-g, glm::dot(g, eye)), dvec4(0.0, 0.0, 0.0, 1.0)};
  return glm::transpose(rows);
}

}  // namespace

std::vector<dmat4> look_at(std::span<const LookAt> cameras) {
  std::vector<dmat4> views;
  views.reserve(cameras.size());
  for (const LookAt& camera : cameras) views.push_back(view_from_world(camera));
  return views;
}

}  // namespace parity::cpu
