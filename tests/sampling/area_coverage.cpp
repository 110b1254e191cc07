#include "cpu_reference/sampling/area_coverage.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "cpu_reference/sampling/pattern.h"
#include "geometry/random.h"
#include "gpu/raster/edge_coverage.h"
#include "gpu/sampling/area_coverage.h"
#include "tests/chart.h"
#include "tests/stage.h"
#include "tests/statistics.h"

namespace parity {
namespace {

struct AreaProblem {
  Polygon polygon;
  int width = 1;
  int height = 1;
};
auto fields_of(const AreaProblem*) {
  return std::tuple{&AreaProblem::polygon, &AreaProblem::width, &AreaProblem::height};
}

/// A star of `corners` corners that does not cross itself, larger or smaller than the picture.
Polygon star(Random& random, int corners, vec2 middle, float radius) {
  Polygon polygon;
  polygon.rings.resize(1);
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::acos(-1.0) * (i + 0.8 * random.uniform()) / corners;
    const float r = radius * random.uniform(0.3f, 1.0f);
    polygon.rings[0].push_back(middle + r * vec2(std::cos(angle), std::sin(angle)));
  }
  return polygon;
}

AreaProblem random_star(const Setting& setting) {
  Random random{setting.seed};
  const int side = setting.count("side");
  AreaProblem p{.width = side, .height = std::max(1, side - 2)};
  p.polygon = star(random, setting.count("corners"), vec2(0.5f * float(side)),
                   float(setting.at("radius")) * float(side));
  return p;
}

template <typename Area>
double largest(const Grid<Area>& got, const Grid<Area>& want) {
  double worst = 0;
  for (std::size_t i = 0; i < want.size(); ++i)
    worst = std::max(worst, std::abs(double(got.values()[i]) - double(want.values()[i])));
  return worst;
}

const Registration registration = register_stage<AreaProblem, Grid<double>>({
    .name = "sampling/area_coverage",
    .title = "Exact area of a polygon in each pixel: the truth for antialiasing",
    .source = "notes 1.8; Catmull 1978; Sutherland & Hodgman 1974",
    .rows = {20},
    .axes = {{.name = "corners",
              .low = 3,
              .high = 200,
              .standard = 12,
              .logarithmic = true,
              .whole = true},
             {.name = "radius",
              .unit = "1 / picture",
              .low = 0.02,
              .high = 20,
              .standard = 0.45,
              .logarithmic = true},
             {.name = "side",
              .unit = "px",
              .low = 1,
              .high = 131,
              .standard = 64,
              .logarithmic = true,
              .whole = true}},
    .problem = random_star,
    .cpu = {{.solve =
                 [](const AreaProblem& p) {
                   return cpu::area_coverage(p.polygon, p.width, p.height);
                 }}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const AreaProblem& p) {
                   const Grid<float> areas =
                       gpu::area_coverage(context, p.polygon, p.width, p.height);
                   Grid<double> result{p.width, p.height};
                   std::copy(areas.begin(), areas.end(), result.begin());
                   return result;
                 }}},
    .distance = largest<double>,
    .tolerance =
        [](const AreaProblem& p) { return gpu::area_coverage_bound(p.polygon, p.width, p.height); },
    .why = "each edge moves by the rounding of its corners relative to the pixel and of the "
           "crossing, 6 2^-24 of the largest coordinate, over 1 px of height; each of the terms "
           "of the sum rounds by 2^-24",
    .chart_axes = {"side"},
});

/// A triangle in the window, as clip positions.
TriangleList triangle_list(const Polygon& triangle, int side, int samples) {
  TriangleList list{.width = side, .height = side, .samples = samples};
  for (const vec2& p : triangle.rings[0])
    list.clip_positions.push_back(vec4(2.0f * p / float(side) - 1.0f, 0.5f, 1.0f));
  list.triangles = {{0, 1, 2}};
  return list;
}

Polygon moved(Polygon polygon, dvec2 by) {
  for (vec2& p : polygon.rings[0]) p = vec2(dvec2(p) + by);
  return polygon;
}

/// Coverage by frames of `samples` samples, shifted by each of `shifts` px.
Grid<double> sampled_coverage(gpu::Context& context, const Polygon& triangle, int side, int samples,
                              const std::vector<dvec2>& shifts) {
  Grid<double> sum{side, side};
  for (const dvec2& shift : shifts) {
    const Coverage c = gpu::edge_coverage(
        context, triangle_list(moved(triangle, shift), side, samples), Snapping::mesa);
    for (std::size_t i = 0; i < c.count.size(); ++i)
      sum.values()[i / std::size_t(samples)] +=
          double(c.count[i] > 0) / (samples * double(shifts.size()));
  }
  return sum;
}

double edge_error(const Grid<double>& got, const Grid<double>& exact) {
  double sum = 0, pixels = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const double area = exact.values()[i];
    if (area <= 0 || area >= 1) continue;
    sum += std::pow(got.values()[i] - area, 2);
    ++pixels;
  }
  return std::sqrt(sum / pixels);
}

std::vector<dvec2> shifts_of(SamplePattern pattern, int count) {
  std::vector<dvec2> shifts = cpu::pattern(pattern, std::uint32_t(count), 1);
  for (dvec2& shift : shifts) shift -= 0.5;
  return shifts;
}

/// Error at the edges of triangles, mean of several, by each way to place samples.
ChartData error_against_samples(gpu::Context& context) {
  constexpr int side = 64, triangles = 6;
  std::vector<Polygon> shapes;
  Random random{7};
  for (int i = 0; i < triangles; ++i) shapes.push_back(star(random, 3, vec2(32), 30));
  std::vector<Grid<double>> exact;
  for (const Polygon& shape : shapes) exact.push_back(cpu::area_coverage(shape, side, side));
  const auto error = [&](int samples, const std::vector<dvec2>& shifts) {
    double sum = 0;
    for (std::size_t i = 0; i < shapes.size(); ++i)
      sum += edge_error(sampled_coverage(context, shapes[i], side, samples, shifts), exact[i]);
    return sum / triangles;
  };
  Series msaa{"MSAA, standard places", {}}, grid{"SSAA, regular grid", {}};
  Series jitter{"jittered accumulation", {}}, multi{"multi-jittered accumulation", {}};
  Series mixed{"multi-jittered accumulation of MSAA 4", {}};
  for (const int n : {1, 2, 4, 8}) msaa.points.push_back({double(n), error(n, {dvec2(0)})});
  for (const int n : {1, 4, 16, 64})
    grid.points.push_back({double(n), error(1, shifts_of(SamplePattern::regular, n))});
  for (const int n : {1, 2, 4, 8, 16, 32, 64}) {
    jitter.points.push_back({double(n), error(1, shifts_of(SamplePattern::jittered, n))});
    const std::vector<dvec2> shifts = shifts_of(SamplePattern::multi_jittered, n);
    multi.points.push_back({double(n), error(1, shifts)});
    if (n > 16) continue;
    std::vector<dvec2> halves;  // each of four samples stands for half a pixel's square
    for (const dvec2& shift : shifts) halves.push_back(0.5 * shift);
    mixed.points.push_back({4.0 * n, error(4, halves)});
  }
  return {.series = {msaa, grid, jitter, multi, mixed},
          .assertions = {{"error of MSAA 8 over error of 1 sample",
                          msaa.points[3].y / msaa.points[0].y, 0.25},
                         {"error of 64 jittered frames over error of 1",
                          jitter.points.back().y / jitter.points[0].y, 0.1},
                         {"error of 64 multi-jittered frames over error of 1",
                          multi.points.back().y / multi.points[0].y, 0.1}},
          .settings = {{"truth", "exact area"}, {"triangles", "6 in 64x64 px"}}};
}

const Registration edge_chart = register_chart({
    .name = "sampling/edge_error",
    .title = "Error of the coverage of edge pixels against samples",
    .x = {.label = "samples a pixel"},
    .y = {.label = "RMSE of coverage"},
    .produce = error_against_samples,
    .fit_slopes = true,
});

}  // namespace
}  // namespace parity
