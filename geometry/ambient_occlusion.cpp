#include "geometry/ambient_occlusion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>

#include "geometry/opaque_frame.h"

namespace parity {
namespace {

void check(const OcclusionOptions& o) {
  if (o.radius >= 0 && o.order >= 1 && o.steps >= 1 && o.order <= 8 && o.steps <= 64) return;
  throw std::invalid_argument("occlusion_problem: radius " + std::to_string(o.radius) + ", order " +
                              std::to_string(o.order) + ", " + std::to_string(o.steps) +
                              " steps; must be at least 0, 1 to 8, and 1 to 64");
}

/// Reversed depth is affine in z, over the distance unless orthographic.
float distance_of(const Frame& frame, float depth) {
  if (!(depth > 0)) return std::numeric_limits<float>::infinity();
  const dmat4& m = frame.clip_from_view;
  if (frame.orthographic) return float((m[3][2] - double(depth)) / m[2][2]);
  return float(m[3][2] / (double(depth) + m[2][2]));
}

}  // namespace

std::vector<vec4> slice_directions(int order) {
  std::vector<ivec2> steps;
  for (int y = 0; y <= order; ++y)
    for (int x = y == 0 ? 1 : -order; x <= order; ++x)
      if (std::gcd(x, y) == 1 && (y > 0 || x == 1)) steps.emplace_back(x, y);
  const auto turn = [](const ivec2& s) { return std::atan2(double(s.y), double(s.x)); };
  std::ranges::sort(steps, {}, turn);
  std::vector<vec4> slices;
  const std::size_t count = steps.size();
  for (std::size_t i = 0; i < count; ++i) {
    const double before = i == 0 ? turn(steps[count - 1]) - std::numbers::pi : turn(steps[i - 1]);
    const double after = i + 1 == count ? std::numbers::pi : turn(steps[i + 1]);
    const dvec2 step{steps[i]};
    slices.emplace_back(step.x, step.y, (after - before) / (2 * std::numbers::pi),
                        1 / glm::length(step));
  }
  return slices;
}

std::vector<float> slice_parts(int steps) {
  std::vector<float> parts;
  for (int i = 1; i <= steps; ++i) parts.push_back(float(double(i) * i / (double(steps) * steps)));
  return parts;
}

OcclusionProblem occlusion_problem(const Scene& scene, const Frame& frame,
                                   const OcclusionOptions& options,
                                   const std::function<Grid<float>(const Frame&)>& depths_of) {
  check(options);
  const Frame opaque = opaque_frame(scene, frame, DepthMode::reverse_z);
  OcclusionProblem problem;
  problem.distances = depths_of(opaque);
  for (float& d : problem.distances) d = distance_of(opaque, d);
  problem.orthographic = frame.orthographic;
  problem.slope = {1 / std::abs(opaque.clip_from_view[0][0]),
                   1 / std::abs(opaque.clip_from_view[1][1])};
  const Bounds bounds = world_bounds(scene);
  const double diagonal = bounds.empty ? 1.0 : glm::length(bounds.max - bounds.min);
  problem.radius = float(options.radius > 0 ? options.radius : 0.1 * diagonal);
  problem.slices = slice_directions(options.order);
  problem.parts = slice_parts(options.steps);
  return problem;
}

}  // namespace parity
