#include "sim/drawing.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace parity {
namespace {

void check_size(const char* who, int width, int height) {
  if (width < 1 || height < 1 || width > 8192 || height > 8192)
    throw std::invalid_argument(std::string(who) + ": the picture is " + std::to_string(width) +
                                "x" + std::to_string(height) + ", must be 1x1 to 8192x8192");
}

bool is_finite(const vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void check(bool is_right, const std::string& what) {
  if (!is_right) throw std::invalid_argument(what);
}

void check_volume(const DrawnVolume& volume) {
  const ivec3 n = volume.size;
  check(n.x >= 1 && n.y >= 1 && n.z >= 1 && n.x <= 4096 && n.y <= 4096 && n.z <= 4096,
        "check_drawn_scene: a side of the volume is not 1 to 4096 cells");
  check(volume.values.size() == std::size_t(n.x) * std::size_t(n.y) * std::size_t(n.z),
        "check_drawn_scene: the volume has " + std::to_string(volume.values.size()) +
            " values, not one a cell");
  check(volume.cell > 0 && std::isfinite(volume.cell) && is_finite(volume.origin),
        "check_drawn_scene: the volume has no place");
  check(std::ranges::all_of(volume.values, [](float v) { return v >= 0 && std::isfinite(v); }),
        "check_drawn_scene: a value of the volume is negative or not finite");
}

}  // namespace

DrawnView perspective_view(ivec2 size, dvec3 eye, dvec3 target, double fov_degrees) {
  const dvec3 forward = glm::normalize(target - eye);
  const dvec3 aside = glm::cross(forward, dvec3(0, 1, 0));
  const dvec3 right = glm::length(aside) > 1e-9 ? glm::normalize(aside) : dvec3(1, 0, 0);
  const double half = std::tan(fov_degrees * std::numbers::pi / 360);
  return {.width = size.x,
          .height = size.y,
          .eye = vec3(eye),
          .right = vec3(right * (half * size.x / size.y)),
          .up = vec3(glm::cross(right, forward) * half),
          .forward = vec3(forward)};
}

DrawnView flat_view(ivec2 size, dvec2 low, dvec2 high) {
  const dvec2 half = 0.52 * (high - low), middle = 0.5 * (low + high);
  const double aspect = double(size.x) / size.y;
  const double tall = std::max(half.y, half.x / aspect);
  const double away = 4 * (half.x + half.y);
  return {.width = size.x,
          .height = size.y,
          .is_orthographic = true,
          .eye = vec3(middle.x, middle.y, away),
          .right = vec3(tall * aspect, 0, 0),
          .up = vec3(0, tall, 0),
          .forward = vec3(0, 0, -1)};
}

DrawnView framing_view(ivec2 picture, dvec3 size, double fov_degrees) {
  const dvec3 towards = glm::normalize(dvec3(0.42, 0.38, 1.0)),
              target = size * dvec3(0.5, 0.42, 0.5);
  const double half = std::tan(fov_degrees * std::numbers::pi / 360);
  double distance = 0;  // the smallest at which no corner leaves the view, with 8 % to spare
  const DrawnView aim = perspective_view(picture, target + towards, target, fov_degrees);
  const dvec3 right = glm::normalize(dvec3(aim.right)), up = glm::normalize(dvec3(aim.up));
  for (int corner = 0; corner < 8; ++corner) {
    const dvec3 p = size * dvec3(corner & 1, (corner >> 1) & 1, corner >> 2) - target;
    const double nearer = glm::dot(p, towards);
    const double aspect = double(picture.x) / picture.y;
    const double reach = std::max(std::abs(glm::dot(p, up)), std::abs(glm::dot(p, right)) / aspect);
    distance = std::max(distance, nearer + 1.08 * reach / half);
  }
  return perspective_view(picture, target + distance * towards, target, fov_degrees);
}

void check_drawn_scene(const DrawnScene& scene) {
  check_size("check_drawn_scene", scene.view.width, scene.view.height);
  check(scene.view.samples >= 1 && scene.view.samples <= 4,
        "check_drawn_scene: " + std::to_string(scene.view.samples) +
            " samples along a pixel, must be 1 to 4");
  check(scene.positions.size() == scene.colors.size(),
        "check_drawn_scene: there are " + std::to_string(scene.positions.size()) +
            " particles and " + std::to_string(scene.colors.size()) + " colours");
  check(scene.positions.empty() || scene.radius > 0, "check_drawn_scene: particles have no radius");
  check(std::ranges::all_of(scene.positions, is_finite),
        "check_drawn_scene: a position is not finite");
  check(scene.solids.size() <= 64, "check_drawn_scene: there are more than 64 solids");
  if (scene.volume.mode == VolumeMode::none) return;
  check_volume(scene.volume);
  check(scene.light.sun.y > 0.1f, "check_drawn_scene: the sun stands too low for a volume");
}

void check_drawn_field(const DrawnField& field) {
  check_size("check_drawn_field", field.width, field.height);
  check(field.cells.x >= 1 && field.cells.y >= 1, "check_drawn_field: there are no cells");
  const std::size_t count = std::size_t(field.cells.x) * std::size_t(field.cells.y);
  check(
      field.velocity.size() == count && field.value.size() == count && field.solid.size() == count,
      "check_drawn_field: not one velocity, value and solid a cell");
  check(field.color_map.size() >= 2 && !field.noise.empty() && field.noise_scale > 0 &&
            field.slowest > 0,
        "check_drawn_field: the colour map or the noise is empty");
  check(field.streak >= 0 && field.streak <= 64,
        "check_drawn_field: streak is " + std::to_string(field.streak) + " px, must be 0 to 64");
  for (std::size_t i = 0; i < count; ++i)
    check(std::isfinite(field.velocity[i].x) && std::isfinite(field.velocity[i].y) &&
              std::isfinite(field.value[i]) && std::isfinite(field.solid[i]),
          "check_drawn_field: a value is not finite");
}

}  // namespace parity
