#include "cpu_reference/raster/wide_line.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace parity::cpu {
namespace {

/// A point seen from the segment: along it from its begin, and to its side.
struct Frame {
  dvec2 origin;
  dvec2 direction;
  double length;

  Frame(dvec2 begin, dvec2 end) : origin(begin), direction(0.0), length(glm::length(end - begin)) {
    if (length > 0.0) direction = (end - begin) / length;
  }
  double along(dvec2 p) const { return glm::dot(p - origin, direction); }
  double aside(dvec2 p) const {
    return direction.x * (p.y - origin.y) - direction.y * (p.x - origin.x);
  }
};

}  // namespace

Grid<std::uint8_t> wide_line(vec2 begin, vec2 end, float line_width, int width, int height) {
  const Frame frame{dvec2(begin), dvec2(end)};
  if (!std::isfinite(frame.length) || !(line_width > 0.0f) || !std::isfinite(line_width))
    throw std::invalid_argument("cpu::wide_line: length " + std::to_string(frame.length) +
                                " and width " + std::to_string(line_width) +
                                " must be finite, the width > 0");
  Grid<std::uint8_t> covered{width, height, std::uint8_t(0)};
  const double half = 0.5 * double(line_width);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const dvec2 center{x + 0.5, y + 0.5};
      const double along = frame.along(center);
      const double aside = frame.aside(center);
      covered(x, y) = along >= 0.0 && along < frame.length && aside >= -half && aside < half;
    }
  return covered;
}

double wide_line_border_distance(vec2 begin, vec2 end, float line_width, dvec2 point) {
  const Frame frame{dvec2(begin), dvec2(end)};
  // How far outside the rectangle in each direction; negative inside.
  const double beyond_ends = std::abs(frame.along(point) - 0.5 * frame.length) - 0.5 * frame.length;
  const double beyond_sides = std::abs(frame.aside(point)) - 0.5 * double(line_width);
  const double outside = std::hypot(std::max(beyond_ends, 0.0), std::max(beyond_sides, 0.0));
  return outside > 0.0 ? outside : -std::max(beyond_ends, beyond_sides);
}

}  // namespace parity::cpu
