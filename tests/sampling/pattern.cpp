#include "cpu_reference/sampling/pattern.h"

#include <algorithm>
#include <cmath>

#include "geometry/random.h"
#include "gpu/sampling/pattern.h"
#include "tests/chart.h"
#include "tests/stage.h"
#include "tests/statistics.h"

namespace parity {
namespace {

struct PatternProblem {
  SamplePattern pattern = SamplePattern::random;
  std::uint32_t count = 1;
  std::uint32_t seed = 1;
};
auto fields_of(const PatternProblem*) {
  return std::tuple{&PatternProblem::pattern, &PatternProblem::count, &PatternProblem::seed};
}

using Samples = std::vector<dvec2>;

/// Farthest of two samples of a number, around the torus.
double torus_distance(const Samples& got, const Samples& want) {
  double worst = 0;
  for (std::size_t i = 0; i < want.size(); ++i)
    for (int axis = 0; axis < 2; ++axis)
      worst = std::max(worst, std::abs(std::remainder(got[i][axis] - want[i][axis], 1.0)));
  return worst;
}

const Registration registration = register_stage<PatternProblem, Samples>({
    .name = "sampling/pattern",
    .title = "Samples of a pixel: random, jittered, multi-jittered, Halton, Sobol, R2, blue noise",
    .source = "notes 1.8; Kensler 2013; Halton 1964; Sobol 1967; Roberts 2018; Mitchell 1991",
    .rows = {21},
    .axes = {{.name = "pattern", .low = 0, .high = 7, .standard = 1, .whole = true, .each = true},
             {.name = "count",
              .low = 1,
              .high = 997,
              .standard = 96,
              .logarithmic = true,
              .whole = true}},
    .problem =
        [](const Setting& s) {
          return PatternProblem{SamplePattern(s.count("pattern")), std::uint32_t(s.count("count")),
                                std::uint32_t(s.seed)};
        },
    .cpu = {{.solve =
                 [](const PatternProblem& p) { return cpu::pattern(p.pattern, p.count, p.seed); }}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const PatternProblem& p) {
                   const std::vector<vec2> samples =
                       gpu::pattern(context, p.pattern, p.count, p.seed);
                   return Samples(samples.begin(), samples.end());
                 }}},
    .distance = torus_distance,
    .tolerance = [](const PatternProblem& p) { return 0x1p-22 + p.count * 0x1p-33; },
    .why = "coordinates in [0, 1] by at most four roundings of 2^-24; the device multiplies 1/g "
           "of 32 bits by the sample's number",
    .chart_axes = {"count"},
});

/// Error of a mean over samples, as a root mean square over integrands and seeds.
template <typename Integrand, typename Exact>
double pattern_error(SamplePattern pattern, std::uint32_t count, const Integrand& integrand,
                     const Exact& exact) {
  constexpr std::uint32_t seeds = 48, functions = 12;
  double sum = 0;
  for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
    const Samples samples = cpu::pattern(pattern, count, seed);
    for (std::uint32_t i = 0; i < functions; ++i) {
      double mean = 0;
      for (const dvec2& p : samples) mean += integrand(i + functions * seed, p);
      sum += std::pow(mean / count - exact(i + functions * seed), 2);
    }
  }
  return std::sqrt(sum / (seeds * functions));
}

/// Edge number i: crosses the pixel.
struct Edge {
  explicit Edge(std::uint32_t i) {
    Random random{i, 3};
    const double angle = random.uniform(0, 6.2831853f);
    normal = {std::cos(angle), std::sin(angle)};
    offset = glm::dot(normal, dvec2(random.uniform(), random.uniform()));
  }
  dvec2 normal;
  double offset;
};

double edge_value(std::uint32_t i, dvec2 p) {
  const Edge edge(i);
  return glm::dot(edge.normal, p) < edge.offset ? 1 : 0;
}
double edge_exact(std::uint32_t i) { return half_plane_area(Edge(i).normal, Edge(i).offset); }

/// exp(a x + b y), a and b from -2 to 2.
dvec2 exponents(std::uint32_t i) {
  Random random{i, 4};
  const double a = random.uniform(-2, 2);
  return {a, double(random.uniform(-2, 2))};
}
double smooth_value(std::uint32_t i, dvec2 p) { return std::exp(glm::dot(exponents(i), p)); }
double smooth_exact(std::uint32_t i) {
  const dvec2 a = exponents(i);
  return std::expm1(a.x) / a.x * std::expm1(a.y) / a.y;
}

template <typename Integrand, typename Exact>
ChartData error_against_samples(const Integrand& integrand, const Exact& exact,
                                double jittered_slope) {
  ChartData data;
  std::vector<double> slopes;
  for (const SamplePattern pattern : all_sample_patterns) {
    Series series{name_of(pattern), {}};
    std::vector<dvec2> points;
    for (const std::uint32_t count : {1u, 4u, 16u, 64u, 256u, 1024u}) {
      series.points.push_back({double(count), pattern_error(pattern, count, integrand, exact)});
      if (count >= 4) points.emplace_back(count, series.points.back().y);
    }
    slopes.push_back(fit_power(points).slope);
    data.series.push_back(series);
  }
  const auto slope = [&](SamplePattern p) { return slopes[std::size_t(p)]; };
  const auto last = [&](SamplePattern p) { return data.series[std::size_t(p)].points.back().y; };
  using enum SamplePattern;
  data.assertions = {
      {"random: slope from -1/2", std::abs(slope(random) + 0.5), 0.06},
      {"jittered: slope", slope(jittered), jittered_slope + 0.08},
      {"sobol, 1024 samples: error over random's", last(sobol) / last(random), 0.25},
      {"r2, 1024 samples: error over random's", last(r2) / last(random), 0.25},
      {"halton, 1024 samples: error over random's", last(halton) / last(random), 0.25},
      {"multi-jittered, 1024 samples: error over random's", last(multi_jittered) / last(random),
       0.25},
      {"blue noise, 1024 samples: error over random's", last(blue_noise) / last(random), 0.6}};
  data.settings = {{"mean over", "12 integrands for each of 48 seeds"}};
  return data;
}

const Registration edge_chart = register_chart({
    .name = "sampling/pattern_edge_error",
    .title = "Coverage of a pixel by an edge: error of sample patterns",
    .x = {.label = "samples"},
    .y = {.label = "RMSE of coverage"},
    .produce = [](gpu::Context&) { return error_against_samples(edge_value, edge_exact, -0.75); },
    .fit_slopes = true,
});

const Registration smooth_chart = register_chart({
    .name = "sampling/pattern_smooth_error",
    .title = "Mean of a smooth function over a pixel: error of sample patterns",
    .x = {.label = "samples"},
    .y = {.label = "RMSE"},
    .produce = [](gpu::Context&) { return error_against_samples(smooth_value, smooth_exact, -1); },
    .fit_slopes = true,
});

}  // namespace
}  // namespace parity
