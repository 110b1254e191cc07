#include <algorithm>
#include <chrono>
#include <cmath>

#include "cpu_reference/raster/rasterize.h"
#include "geometry/random.h"
#include "gpu/raster/edge_coverage.h"
#include "tests/chart.h"
#include "tests/raster/triangles.h"

/// How wrong sampled coverage is: against the exact area of a triangle in each pixel, and as the
/// grid that vertices snap to gets coarser.
namespace parity {
namespace {

using Points = std::vector<dvec2>;

/// The part of a convex polygon where normal . p >= offset.
Points cut(const Points& polygon, dvec2 normal, double offset) {
  Points kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const dvec2 a = polygon[i];
    const dvec2 b = polygon[(i + 1) % polygon.size()];
    const double da = glm::dot(normal, a) - offset;
    const double db = glm::dot(normal, b) - offset;
    if (da >= 0) kept.push_back(a);
    if ((da < 0) != (db < 0)) kept.push_back(a + (b - a) * (da / (da - db)));
  }
  return kept;
}

double area(const Points& p) {
  double twice = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const dvec2 a = p[i], b = p[(i + 1) % p.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return std::abs(twice) / 2;
}

Points window_corners(const TriangleList& list, const uvec3& triangle) {
  Points corners;
  for (int i = 0; i < 3; ++i) {
    const dvec4 c{list.clip_positions[triangle[i]]};
    corners.push_back((dvec2(c) / c.w + 1.0) * 0.5 * dvec2(list.width, list.height));
  }
  return corners;
}

/// Sum over triangles of the area that each covers of each pixel.
std::vector<double> exact_coverage(const TriangleList& list) {
  std::vector<double> covered(std::size_t(list.width) * std::size_t(list.height), 0.0);
  for (const uvec3& triangle : list.triangles) {
    const Points corners = window_corners(list, triangle);
    dvec2 low{1e9}, high{-1e9};
    for (const dvec2& c : corners) low = glm::min(low, c), high = glm::max(high, c);
    for (int y = std::max(0, int(low.y)); y <= std::min(list.height - 1, int(high.y)); ++y)
      for (int x = std::max(0, int(low.x)); x <= std::min(list.width - 1, int(high.x)); ++x) {
        Points part = cut(cut(corners, {1, 0}, x), {-1, 0}, -(x + 1.0));
        part = cut(cut(part, {0, 1}, y), {0, -1}, -(y + 1.0));
        covered[std::size_t(y * list.width + x)] += area(part);
      }
  }
  return covered;
}

double root_mean_square_error(const Coverage& coverage, const std::vector<double>& exact) {
  double sum = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    double covered = 0;
    for (int s = 0; s < coverage.samples; ++s)
      covered += coverage.count[i * std::size_t(coverage.samples) + std::size_t(s)];
    sum += std::pow(covered / coverage.samples - exact[i], 2);
  }
  return std::sqrt(sum / double(exact.size()));
}

/// Best of five, ms: what the method costs when nothing disturbs it.
template <typename Method>
double milliseconds(const Method& method) {
  double best = 1e9;
  for (int i = 0; i < 5; ++i) {
    const auto start = std::chrono::steady_clock::now();
    method();
    best = std::min(
        best, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
                  .count());
  }
  return best;
}

ChartData error_against_time(gpu::Context& context) {
  TriangleList list = raster_test::make_triangles(raster_test::Kind::mesh, 256, 1, 800, 5);
  list.triangles.resize(list.triangles.size() / 2);  // half a mesh: edges show
  for (std::size_t i = 1; i < list.triangles.size(); i += 2)
    list.triangles[i] = list.triangles[i - 1];
  const std::vector<double> exact = exact_coverage(list);
  const Snapping snapping = raster_test::for_device(list, context.info()).snapping;
  Series compute{"device, compute", {}}, hardware{"device, fixed function", {}},
      reference{"CPU reference", {}};
  for (const int samples : {1, 2, 4, 8}) {
    list.samples = samples;
    const std::string label = std::to_string(samples) + "x";
    Coverage coverage;
    const auto add = [&](Series& series, const auto& method) {
      const double time = milliseconds([&] { coverage = method(); });
      series.points.push_back({time, root_mean_square_error(coverage, exact), label});
    };
    add(reference, [&] { return cpu::span_coverage(list, snapping); });
    add(compute, [&] { return gpu::edge_coverage(context, list, snapping); });
    const std::vector<int>& counts = context.info().sample_counts;
    if (std::find(counts.begin(), counts.end(), samples) != counts.end())
      add(hardware, [&] { return gpu::hardware_coverage(context, list); });
  }
  ChartData data{.series = {reference, compute, hardware}};
  data.assertions.push_back({"error of 8 samples over error of 1",
                             compute.points.back().y / compute.points.front().y,
                             std::pow(8, -0.5)});
  data.settings = {{"picture", "256x256"},
                   {"triangles", std::to_string(list.triangles.size())},
                   {"time", "whole call with upload and readback, best of 5"}};
  return data;
}

const Registration chart = register_chart({
    .name = "raster/coverage_error",
    .title = "Error of sampled coverage against the exact area",
    .x = {.label = "time", .unit = "ms"},
    .y = {.label = "RMSE of a pixel's coverage"},
    .produce = error_against_time,
    .pareto = true,
});

/// Counts a clockwise triangle (y down) on the pixels whose centre it holds.
void add_centres_inside(const Points& c, int side, std::vector<double>& counts) {
  const dvec2 low = glm::max(glm::min(glm::min(c[0], c[1]), c[2]), dvec2(0));
  const dvec2 high = glm::min(glm::max(glm::max(c[0], c[1]), c[2]), dvec2(side - 1));
  for (int y = int(low.y); y <= int(high.y); ++y)
    for (int x = int(low.x); x <= int(high.x); ++x) {
      const dvec2 p{x + 0.5, y + 0.5};
      bool inside = true;
      for (std::size_t k = 0; k < 3; ++k) {
        const dvec2 a = c[k];
        const dvec2 b = c[(k + 1) % 3];
        inside = inside && (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) >= 0;
      }
      counts[std::size_t(y * side + x)] += inside;
    }
}

/// Fraction of covered samples that change when vertices snap to 2^-bits px.
double changed_samples(gpu::Context& context, double bits, double size) {
  constexpr int side = 256;
  const double steps = std::exp2(std::round(bits));
  Random random{11};
  TriangleList fine{.width = side, .height = side, .samples = 1};
  // Enough that one in a hundred of the covered samples is dozens.
  const int count = int(std::clamp(8000 / (size * size), 300.0, 40000.0));
  for (int i = 0; i < count; ++i) {
    const dvec2 middle{random.uniform(40, side - 40), random.uniform(40, side - 40)};
    const double turn = random.uniform(0, 6.28f);
    for (int k = 0; k < 3; ++k) {
      const double angle = turn + k * 2.0943951;
      const dvec2 p = middle + size / std::sqrt(3.0) * dvec2(std::cos(angle), std::sin(angle));
      fine.clip_positions.push_back(vec4(dvec4(p / (side / 2.0) - 1.0, 0.5, 1)));
    }
    const auto first = std::uint32_t(3 * i);
    fine.triangles.push_back({first, first + 1, first + 2});
  }
  TriangleList coarse = fine;
  for (vec4& c : coarse.clip_positions) {
    const dvec2 pixel = (dvec2(c) + 1.0) * (side / 2.0);
    c = vec4(dvec4(glm::round(pixel * steps) / steps / (side / 2.0) - 1.0, 0.5, 1));
  }
  const Coverage got = gpu::edge_coverage(context, coarse, Snapping::mesa);
  std::vector<double> want(got.count.size(), 0.0);
  for (const uvec3& t : fine.triangles) add_centres_inside(window_corners(fine, t), side, want);
  double changed = 0;
  double covered = 0;
  for (std::size_t i = 0; i < want.size(); ++i) {
    covered += want[i];
    changed += std::abs(double(got.count[i]) - want[i]);
  }
  return covered > 0 ? changed / covered : 1;
}

/// A vertex moves by up to half a step s in x and y; an edge by the mean of its ends: across it, a
/// root mean square of s / sqrt(12) sqrt(2/3), a mean of 0.8 of that. Over the perimeter 3 a and
/// the area sqrt(3)/4 a^2 of an equilateral triangle: 1.3 s / a. At 1 %: a = 130 s.
double size_of_one_percent(double bits) { return 130 * std::exp2(-bits); }

const Registration map = register_map({
    .name = "raster/snapping",
    .title = "Covered samples that change when corners snap to a grid",
    .x = {.name = "sub-pixel bits", .low = 1, .high = 8, .standard = 8, .whole = true},
    .y = {.name = "triangle side",
          .unit = "px",
          .low = 0.5,
          .high = 60,
          .standard = 8,
          .logarithmic = true},
    .value_label = "changed samples",
    .border = 0.01,
    .columns = 8,
    .rows = 14,
    .value = changed_samples,
    .theory = {{"1.3 step / side = 1 %", size_of_one_percent}},
});

}  // namespace
}  // namespace parity
