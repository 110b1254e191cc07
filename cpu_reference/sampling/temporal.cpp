#include "cpu_reference/sampling/temporal.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace parity::cpu {
namespace {

/// The sum of the tents of all pixels that reach a place.
dvec4 between(const Grid<vec4>& picture, dvec2 place) {
  dvec4 sum{0.0};
  const ivec2 near{glm::floor(place)};
  for (int y = near.y - 1; y <= near.y + 1; ++y)
    for (int x = near.x - 1; x <= near.x + 1; ++x) {
      const dvec2 apart = glm::abs(place - dvec2(x + 0.5, y + 0.5));
      const double weight = std::max(0.0, 1 - apart.x) * std::max(0.0, 1 - apart.y);
      const int column = std::clamp(x, 0, picture.width() - 1);
      const int row = std::clamp(y, 0, picture.height() - 1);
      sum += weight * dvec4(picture(column, row));
    }
  return sum;
}

dvec4 step_at(const TemporalStep& step, int x, int y) {
  const Grid<vec4>& current = step.current;
  const int w = current.width(), h = current.height();
  const dvec3 color{current(x, y)};
  const dvec2 place = dvec2(x + 0.5, y + 0.5) + dvec2(step.motion(x, y));
  if (place.x < 0 || place.y < 0 || place.x > w || place.y > h) return dvec4(color, 1);
  const dvec4 past = between(step.history, place);
  dvec3 old{past};
  double frames = past.w;
  if (step.clamps) {
    double loss = 0;
    for (int c = 0; c < 3; ++c) {
      double low = color[c], high = color[c];
      for (int j = std::max(0, y - 1); j < std::min(h, y + 2); ++j)
        for (int i = std::max(0, x - 1); i < std::min(w, x + 2); ++i) {
          low = std::min(low, double(current(i, j)[c]));
          high = std::max(high, double(current(i, j)[c]));
        }
      const double outside = std::max({0.0, low - old[c], old[c] - high});
      loss = std::max(loss, outside / (high - low + 1.0 / 16));
      old[c] = std::clamp(old[c], low, high);
    }
    frames *= std::max(0.0, 1 - loss);
  }
  const double total = std::min(frames + 1, double(step.longest));
  return dvec4(((total - 1) * old + color) / total, total);
}

}  // namespace

Grid<dvec4> accumulate(const TemporalStep& step) {
  const int w = step.current.width(), h = step.current.height();
  const auto fits = [&](const auto& grid) { return grid.width() == w && grid.height() == h; };
  if (step.current.empty() || !fits(step.history) || !fits(step.motion) || !(step.longest >= 1))
    throw std::invalid_argument(
        "cpu::accumulate: pictures must be of one size above 0, longest at least 1");
  Grid<dvec4> result{w, h};
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) result(x, y) = step_at(step, x, y);
  return result;
}

}  // namespace parity::cpu
