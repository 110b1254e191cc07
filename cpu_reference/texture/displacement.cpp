#include "cpu_reference/texture/displacement.h"

#include <algorithm>
#include <cmath>

#include "cpu_reference/texture/sample.h"

namespace parity::cpu {
namespace {

/// A point of a triangle before it is displaced.
struct SurfacePoint {
  dvec3 position;
  dvec3 normal;
  dvec2 uv;
};

class Surface {
 public:
  explicit Surface(const DisplacementProblem& problem)
      : problem_(problem), levels_{problem.heights} {}

  dvec3 displaced(const SurfacePoint& p) const {
    const double height = sample({levels_, false, {}}, p.uv, 0.0).value.x;
    return p.position + p.normal * (double(problem_.scale) * height);
  }
  dvec2 pixel(const dvec3& p) const {
    const dvec4 clip = dmat4(problem_.clip_from_world) * dvec4(p, 1.0);
    return dvec2(clip) / std::max(clip.w, 1e-6) * dvec2(problem_.size) / 2.0;
  }

 private:
  const DisplacementProblem& problem_;
  std::array<Grid<u8vec4>, 1> levels_;
};

SurfacePoint point_of(const DisplacementCorner& c) {
  return {dvec3(c.position), dvec3(c.normal), dvec2(c.uv)};
}

/// The point of barycentric coordinates b.
SurfacePoint weighted(const std::array<SurfacePoint, 3>& corners, dvec3 b) {
  SurfacePoint sum{dvec3(0), dvec3(0), dvec2(0)};
  for (int i = 0; i < 3; ++i) {
    const SurfacePoint& c = corners[std::size_t(i)];
    sum.position += b[i] * c.position;
    sum.normal += b[i] * c.normal;
    sum.uv += b[i] * c.uv;
  }
  return sum;
}

std::array<double, 6> errors_between(const Surface& surface, const SurfacePoint& a,
                                     const SurfacePoint& b) {
  std::array<dvec3, displacement_samples + 1> points{};
  for (int i = 0; i <= displacement_samples; ++i) {
    const double t = double(i) / displacement_samples;
    points[std::size_t(i)] = surface.displaced(weighted({a, b, b}, {1 - t, t, 0}));
  }
  std::array<double, 6> errors{};
  for (int level = 0; level < 6; ++level) {
    const int length = displacement_samples >> level;
    for (int i = 0; i < displacement_samples; ++i) {
      const int begin = i / length * length;
      const dvec3 chord = glm::mix(points[std::size_t(begin)], points[std::size_t(begin + length)],
                                   double(i - begin) / length);
      errors[std::size_t(level)] =
          std::max(errors[std::size_t(level)],
                   glm::distance(surface.pixel(points[std::size_t(i)]), surface.pixel(chord)));
    }
  }
  return errors;
}

std::uint32_t factor(const std::array<double, 6>& errors, double max_pixels) {
  std::uint32_t level = 0;
  while (level < 5 && errors[level] > max_pixels) ++level;
  return 1u << level;
}

std::array<SurfacePoint, 3> triangle(const DisplacementProblem& p, std::size_t index) {
  return {point_of(p.corners[3 * index]), point_of(p.corners[3 * index + 1]),
          point_of(p.corners[3 * index + 2])};
}

/// Lattice coordinates (of n parts along each edge) with those on an edge moved to its own points.
dvec3 snapped(ivec3 lattice, const uvec4& factors) {
  const int n = int(factors.w);
  dvec3 b(lattice);
  for (int opposite = 0; opposite < 3; ++opposite) {
    const int first = (opposite + 1) % 3, second = (opposite + 2) % 3;
    const bool is_corner = lattice[first] == n || lattice[second] == n;
    if (lattice[opposite] != 0 || is_corner) continue;
    // Halves go up, counted from corner 0, or from corner 1 where corner 0 is opposite.
    const int from = opposite == 0 ? 1 : 0, to = 3 - opposite - from;
    const double step = double(n) / factors[opposite];
    b[to] = std::floor(lattice[to] / step + 0.5) * step;
    b[from] = n - b[to];
  }
  return b / double(n);
}

}  // namespace

std::array<double, 6> edge_errors(const DisplacementProblem& problem, const DisplacementCorner& a,
                                  const DisplacementCorner& b) {
  return errors_between(Surface(problem), point_of(a), point_of(b));
}

std::vector<uvec4> displacement_factors(const DisplacementProblem& problem) {
  const Surface surface(problem);
  std::vector<uvec4> factors;
  for (std::size_t i = 0; i < problem.corners.size() / 3; ++i) {
    const std::array<SurfacePoint, 3> corners = triangle(problem, i);
    uvec4 parts{1, 1, 1, 1};
    for (int k = 0; k < 3; ++k) {
      const SurfacePoint& a = corners[std::size_t((k + 1) % 3)];
      const SurfacePoint& b = corners[std::size_t((k + 2) % 3)];
      parts[k] = factor(errors_between(surface, a, b), problem.max_pixels);
      const SurfacePoint middle = weighted({a, b, b}, {0.5, 0.5, 0});
      const std::uint32_t median =
          factor(errors_between(surface, corners[std::size_t(k)], middle), problem.max_pixels);
      parts.w = std::max({parts.w, parts[k], median});
    }
    factors.push_back(parts);
  }
  return factors;
}

std::vector<dvec3> displaced_corners(const DisplacementProblem& problem,
                                     const std::vector<uvec4>& factors) {
  const Surface surface(problem);
  std::vector<dvec3> result;
  for (std::size_t i = 0; i < factors.size(); ++i) {
    const std::array<SurfacePoint, 3> corners = triangle(problem, i);
    const int n = int(factors[i].w);
    const auto add = [&](int row, int column) {
      const dvec3 b = snapped({n - row, row - column, column}, factors[i]);
      result.push_back(surface.displaced(weighted(corners, b)));
    };
    for (int row = 0; row < n; ++row)
      for (int column = 0; column <= row; ++column) {
        add(row, column), add(row + 1, column), add(row + 1, column + 1);
        if (column == row) continue;
        add(row, column), add(row + 1, column + 1), add(row, column + 1);
      }
  }
  return result;
}

}  // namespace parity::cpu
