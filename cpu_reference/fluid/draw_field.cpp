#include "cpu_reference/fluid/draw_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace parity::cpu {
namespace {

/// Weighted sum over the four cells around a point of the picture, in px from its upper left.
template <typename Value, typename At>
Value between_cells(const DrawnField& field, const dvec2& pixel, At at) {
  const double column = pixel.x * field.cells.x / field.width - 0.5;
  const double row = (field.height - pixel.y) * field.cells.y / field.height - 0.5;
  const double x = std::clamp(column, 0.0, field.cells.x - 1.0);
  const double y = std::clamp(row, 0.0, field.cells.y - 1.0);
  Value sum{0};
  for (int j = int(y); j <= int(y) + 1 && j < field.cells.y; ++j)
    for (int i = int(x); i <= int(x) + 1 && i < field.cells.x; ++i)
      sum += (1 - std::abs(x - i)) * (1 - std::abs(y - j)) *
             Value(at[std::size_t(j) * std::size_t(field.cells.x) + std::size_t(i)]);
  return sum;
}

dvec2 direction(const DrawnField& field, const dvec2& pixel) {
  const dvec2 v = between_cells<dvec2>(field, pixel, field.velocity);
  return dvec2(v.x, -v.y) / (glm::length(v) + double(field.slowest));
}

double noise_at(const DrawnField& field, const dvec2& pixel) {
  const dvec2 at = pixel / double(field.noise_scale) - 0.5, low = glm::floor(at);
  const auto wrapped = [](int i, int n) { return (i % n + n) % n; };
  double sum = 0;
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i)
      sum += (1 - std::abs(at.x - low.x - i)) * (1 - std::abs(at.y - low.y - j)) *
             double(field.noise(wrapped(int(low.x) + i, field.noise.width()),
                                wrapped(int(low.y) + j, field.noise.height())));
  return sum;
}

/// Mean noise along the streamline.
double streamline_noise(const DrawnField& field, const dvec2& pixel) {
  double sum = noise_at(field, pixel), total = 1;
  for (const double sense : {1.0, -1.0}) {
    dvec2 p = pixel;
    for (int k = 1; k <= field.streak; ++k) {
      const dvec2 halfway = p + sense / 2 * direction(field, p);
      p += sense * direction(field, halfway);
      const double weight = std::pow(std::cos(std::numbers::pi * k / (2.0 * field.streak + 2)), 2);
      sum += weight * noise_at(field, p);
      total += weight;
    }
  }
  return sum / total;
}

dvec3 color_of(const DrawnField& field, double value) {
  const std::size_t last = field.color_map.size() - 1;
  const double at = std::clamp(value, 0.0, 1.0) * double(last);
  const std::size_t low = std::min(std::size_t(at), last - 1);
  return glm::mix(dvec3(field.color_map[low]), dvec3(field.color_map[low + 1]), at - double(low));
}

dvec4 pixel_of(const DrawnField& field, const dvec2& pixel) {
  const double gain = 1.5 * std::sqrt(std::max(field.streak, 1));
  const double streak = std::clamp((streamline_noise(field, pixel) - 0.5) * gain, -1.0, 1.0) *
                        glm::length(direction(field, pixel));
  const dvec3 color = color_of(field, between_cells<double>(field, pixel, field.value)) *
                      (1 + double(field.contrast) * streak);
  const double solid = between_cells<double>(field, pixel, field.solid);
  return dvec4(glm::mix(color, dvec3(field.solid_color), solid), 1);
}

}  // namespace

Grid<dvec4> draw_field(const DrawnField& field) {
  check_drawn_field(field);
  Grid<dvec4> picture{field.width, field.height};
#pragma omp parallel for schedule(static)
  for (int y = 0; y < field.height; ++y)
    for (int x = 0; x < field.width; ++x) picture(x, y) = pixel_of(field, dvec2(x, y) + 0.5);
  return picture;
}

}  // namespace parity::cpu
