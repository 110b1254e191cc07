#include "geometry/behind.h"

#include <algorithm>

namespace parity {
namespace {

/// What texel `i` of `count` covers of a row of `side` texels: the first one and the parts of it
/// and of those that follow.
struct Cover {
  int first = 0;
  std::vector<double> parts;
};

Cover cover(int i, int count, int side) {
  const double size = double(side) / count, low = i * size, high = low + size;
  Cover result{int(low), {}};
  for (int k = result.first; k < side && k < high; ++k)
    result.parts.push_back((std::min(high, k + 1.0) - std::max(low, double(k))) / size);
  return result;
}

Grid<vec4> halved(const Grid<vec4>& from) {
  Grid<vec4> to{std::max(1, from.width() / 2), std::max(1, from.height() / 2)};
  for (int y = 0; y < to.height(); ++y) {
    const Cover rows = cover(y, to.height(), from.height());
    for (int x = 0; x < to.width(); ++x) {
      const Cover columns = cover(x, to.width(), from.width());
      dvec4 sum{0.0};
      for (std::size_t j = 0; j < rows.parts.size(); ++j)
        for (std::size_t i = 0; i < columns.parts.size(); ++i)
          sum += rows.parts[j] * columns.parts[i] *
                 dvec4(from(columns.first + int(i), rows.first + int(j)));
      to(x, y) = vec4(sum);
    }
  }
  return to;
}

}  // namespace

std::vector<Grid<vec4>> picture_levels(const Grid<vec4>& picture) {
  std::vector<Grid<vec4>> levels{picture};
  while (levels.back().width() > 1 || levels.back().height() > 1)
    levels.push_back(halved(levels.back()));
  return levels;
}

}  // namespace parity
