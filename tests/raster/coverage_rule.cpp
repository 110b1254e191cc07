#include "tests/raster/coverage_rule.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace parity::raster_test {
namespace {

using Corners = std::array<dvec4, 3>;

bool is_inside(const dvec4& p) {
  return p.z >= 0 && p.z <= p.w && std::abs(p.x) <= p.w && std::abs(p.y) <= p.w;
}

/// The smallest w of what lies before the near plane, z >= 0.
double least_w(const Corners& corners) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const dvec4 &a = corners[i], &b = corners[(i + 1) % 3];
    if (a.z >= 0) least = std::min(least, a.w);
    if ((a.z >= 0) != (b.z >= 0)) least = std::min(least, a.w + (b.w - a.w) * a.z / (a.z - b.z));
  }
  return least;
}

double largest_coordinate(const Corners& corners) {
  double largest = 0;
  for (const dvec4& c : corners)
    for (int i = 0; i < 4; ++i) largest = std::max(largest, std::abs(c[i]));
  return largest;
}

}  // namespace

bool CoverageRule::Doubt::at(dvec2 place) const {
  bool near = false;
  for (const Side& side : sides) {
    const double distance = glm::dot(side.distance, dvec3(place, 1));
    if (distance < -side.reach) return false;
    near |= distance <= side.reach;
  }
  return near;
}

CoverageRule::CoverageRule(const RasterProblem& problem) {
  for (std::uint32_t t = 0; t < problem.list.triangles.size(); ++t) add(problem, t);
}

// In homogeneous window coordinates a triangle is the set of points p = M beta, beta >= 0, with its
// corners as columns of M, whichever sign w has: the rows of M^-1 are its sides (Olano & Greer
// 1997), and the sum of beta_i z_i is its depth z / w.
//
// Roundings, in units of u = 2^-24: a new corner's clip coordinates are off by 3 of the largest
// coordinate m for each of up to three planes that meet there, its place by S/2 (1/w + |x|/w^2) of
// that; the viewport adds 3 of the largest coordinate in the window.
void CoverageRule::add(const RasterProblem& problem, std::uint32_t triangle) {
  const TriangleList& list = problem.list;
  Corners clip;
  for (int i = 0; i < 3; ++i)
    clip[std::size_t(i)] = list.clip_positions[list.triangles[triangle][i]];
  if (problem.snapping_is_known && std::all_of(clip.begin(), clip.end(), is_inside)) return;
  const dvec2 half = 0.5 * dvec2(list.width, list.height);
  dmat3 corners;
  dvec3 z;
  double extent = std::max(list.width, list.height);  // of the corners that may stay
  for (int i = 0; i < 3; ++i) {
    const dvec4& c = clip[std::size_t(i)];
    corners[i] = dvec3((dvec2(c) + c.w) * half, c.w);
    z[i] = c.z;
    const dvec2 window = glm::abs(dvec2(corners[i])) / c.w;
    if (c.z >= 0 && c.z <= c.w) extent = std::max({extent, window.x, window.y});
  }
  const double size = largest_coordinate(clip) / least_w(clip);
  if (glm::determinant(corners) == 0 || !std::isfinite(size)) return;  // nothing of it is seen
  const double u = 0x1p-24;
  // Where the direction of rounding is not known it may be a whole step.
  const double step = std::exp2(-problem.subpixel_bits) * (problem.snapping_is_known ? 0.5 : 1.0);
  const double side = std::max(list.width, list.height);
  const double reach =
      std::sqrt(2.0) * (step + u * (3 * std::min(extent, 0x1p15) + 9 * side * size));
  Doubt doubt{.triangle = triangle, .sides = {}};
  const auto add_side = [&](dvec3 plane, double slack) {
    const double gradient = glm::length(dvec2(plane));
    if (gradient > 0) doubt.sides.push_back({plane / gradient, reach + slack / gradient});
  };
  const dmat3 rows = glm::transpose(glm::inverse(corners));
  for (int i = 0; i < 3; ++i) add_side(rows[i], 0);
  const dvec3 depth = rows * z;
  add_side(depth, 9 * u * size);
  add_side(dvec3(0, 0, 1) - depth, 9 * u * size);
  doubts_.push_back(doubt);
}

bool CoverageRule::may_differ(dvec2 place, std::size_t sample, const Coverage& got,
                              const Coverage& want) const {
  std::uint32_t count = 0;
  bool last_may = got.last[sample] == want.last[sample];
  for (const Doubt& doubt : doubts_) {
    if (!doubt.at(place)) continue;
    ++count;
    last_may |= doubt.triangle + 1 == got.last[sample] || doubt.triangle + 1 == want.last[sample];
  }
  const std::uint32_t apart = std::max(got.count[sample], want.count[sample]) -
                              std::min(got.count[sample], want.count[sample]);
  return last_may && apart <= count && count > 0;
}

std::size_t CoverageRule::wrong_samples(const Coverage& got, const Coverage& want) const {
  const std::vector<ivec2> places = standard_sample_places(want.samples);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < want.count.size(); ++i) {
    if (got.count[i] == want.count[i] && got.last[i] == want.last[i]) continue;
    const std::size_t pixel = i / std::size_t(want.samples);
    const dvec2 corner{double(pixel % std::size_t(want.width)),
                       double(pixel / std::size_t(want.width))};
    const dvec2 place = corner + dvec2(places[i % std::size_t(want.samples)]) / 16.0;
    wrong += !may_differ(place, i, got, want);
  }
  return wrong;
}

double wrong_samples(const RasterProblem& problem, const Coverage& got, const Coverage& want) {
  return double(CoverageRule(problem).wrong_samples(got, want));
}

}  // namespace parity::raster_test
