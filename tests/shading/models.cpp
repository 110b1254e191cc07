#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "cpu_reference/shading/albedo_table.h"
#include "cpu_reference/shading/brdf.h"
#include "gpu/core/buffer.h"
#include "gpu/core/commands.h"
#include "gpu/core/kernel.h"
#include "shaders.h"
#include "tests/chart.h"
#include "tests/shading/queries.h"

namespace parity {
namespace {

using namespace shading_test;

/// What gold's index of refraction is about, at the primaries of sRGB.
constexpr dvec3 gold_index{0.18, 0.42, 1.37}, gold_absorption{3.42, 2.35, 1.77};

dvec3 gold_reflectance(double cosine) {
  dvec3 f;
  for (int c = 0; c < 3; ++c) f[c] = cpu::fresnel_exact(gold_index[c], gold_absorption[c], cosine);
  return f;
}

/// L*, a*, b* of light in linear sRGB, where 1 is a perfect diffuser that faces the light.
/// Source: CIE 15:2004, 8.2.1; IEC 61966-2-1.
dvec3 lab_of(const dvec3& rgb) {
  const auto curve = [](double t) {
    return t > 216.0 / 24389 ? std::cbrt(t) : (24389.0 / 27 * t + 16) / 116;
  };
  const double x = curve(glm::dot(rgb, dvec3(0.4124, 0.3576, 0.1805)) / 0.9505);
  const double y = curve(glm::dot(rgb, dvec3(0.2126, 0.7152, 0.0722)));
  const double z = curve(glm::dot(rgb, dvec3(0.0193, 0.1192, 0.9505)) / 1.089);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

/// All bounces with the exact Fresnel term: one of Cook and Torrance and Kulla and Conty's lobe
/// with means that are integrated here.
class Truth {
 public:
  explicit Truth(double alpha) : alpha_(alpha) {
    for (int i = 0; i <= last; ++i)
      lost_.push_back(1 -
                      cpu::directional_albedo(alpha, std::max(1e-3, double(i) / last), 64).total());
    constexpr int steps = 256;
    for (int i = 0; i < steps; ++i) {
      const double c = (i + 0.5) / steps;
      mean_lost_ += 2 * c * lost(c) / steps;
      mean_reflectance_ += 2 * c * gold_reflectance(c) / double(steps);
    }
  }

  dvec3 value(BrdfQuery q) const {
    q.model = brdf_ggx;
    q.fresnel = fresnel_conductor;
    q.color = vec3(gold_index);
    q.absorption = vec3(gold_absorption);
    const dvec3 further = mean_reflectance_ * mean_reflectance_ * (1 - mean_lost_) /
                          (1.0 - mean_reflectance_ * mean_lost_);
    const double lobe =
        lost(q.to_light.z) * lost(q.to_eye.z) / (std::numbers::pi * std::max(mean_lost_, 1e-9));
    return cpu::brdf(q, {}) + lobe * further;
  }

 private:
  static constexpr int last = 64;
  double lost(double cosine) const {
    const double x = cosine * last;
    const int i = std::min(int(x), last - 1);
    return glm::mix(lost_[i], lost_[i + 1], x - i);
  }
  double alpha_;
  std::vector<double> lost_;  ///< by the cosine, what one bounce of a white metal loses
  double mean_lost_ = 0;
  dvec3 mean_reflectance_{0};
};

struct Model {
  const char* name;
  std::uint32_t model;
  std::uint32_t fresnel;
};
constexpr Model models[] = {
    {"Lambert", brdf_lambert, fresnel_schlick},
    {"Blinn-Phong, as bright", brdf_blinn_phong_normalized, fresnel_schlick},
    {"Beckmann, Schlick's Fresnel", brdf_beckmann, fresnel_schlick},
    {"GGX, Schlick's Fresnel", brdf_ggx, fresnel_schlick},
    {"GGX, exact Fresnel", brdf_ggx, fresnel_conductor},
    {"GGX, all bounces, Schlick's Fresnel", brdf_ggx_multi_scatter, fresnel_schlick},
};

std::vector<BrdfQuery> lit_places(const Model& model, double roughness, int count) {
  Random random{5};
  std::vector<BrdfQuery> queries;
  for (int i = 0; i < count; ++i) {
    const vec3 to_light = upward(random), to_eye = upward(random);
    BrdfQuery q = microfacet_query(model.model, roughness, to_light, to_eye);
    q.fresnel = model.fresnel;
    q.exponent = float(2 / std::pow(roughness, 4) - 2);
    q.color = vec3(model.fresnel == fresnel_conductor ? gold_index : gold_reflectance(1));
    q.absorption = vec3(gold_absorption);
    queries.push_back(q);
  }
  return queries;
}

/// The device's values of one model, as often as wanted.
class Shading {
 public:
  Shading(gpu::Context& context, const std::vector<BrdfQuery>& queries)
      : context_(context),
        queries_(context, queries),
        table_(context, albedo_table().values()),
        values_(context, queries.size()),
        kernel_(context, gpu::shaders::shading_brdf_comp) {}

  double run() {
    const auto count = std::uint32_t(queries_.count());
    return context_
        .run([&](gpu::Commands& commands) {
          commands.dispatch(kernel_, {count}, BrdfArgs{queries_, table_, values_, count, 0});
        })
        .seconds;
  }
  std::vector<vec3> values() const { return values_.read(); }

 private:
  gpu::Context& context_;
  gpu::Buffer<BrdfQuery> queries_;
  gpu::Buffer<vec4> table_;
  gpu::Buffer<vec3> values_;
  gpu::Kernel<BrdfArgs> kernel_;
};

/// Mean difference of colours under one light, at the first places.
double mean_difference(const Truth& truth, const std::vector<BrdfQuery>& queries,
                       const std::vector<vec3>& values) {
  constexpr std::size_t judged = 8192;
  double sum = 0;
  for (std::size_t i = 0; i < judged; ++i) {
    const double lit = std::numbers::pi * double(queries[i].to_light.z);
    sum += glm::distance(lab_of(lit * dvec3(values[i])), lab_of(lit * truth.value(queries[i])));
  }
  return sum / judged;
}

ChartData differences(gpu::Context& context) {
  constexpr int count = 1 << 17;
  constexpr double roughnesses[] = {0.3, 0.6, 1.0};
  std::vector<double> nanoseconds(std::size(models)), apart(std::size(models));
  double largest = 0;  // of the last model
  for (const double roughness : roughnesses) {
    const Truth truth(roughness * roughness);
    std::vector<std::vector<BrdfQuery>> queries;
    std::vector<Shading> shadings;
    shadings.reserve(std::size(models));
    for (const Model& model : models) {
      queries.push_back(lit_places(model, roughness, count));
      shadings.emplace_back(context, queries.back());
    }
    std::vector<double> least(std::size(models), 1e9);
    for (int turn = 0; turn < 7; ++turn)
      for (std::size_t m = 0; m < shadings.size(); ++m)
        least[m] = std::min(least[m], 1e9 * shadings[m].run() / count);
    double difference = 0;
    for (std::size_t m = 0; m < shadings.size(); ++m) {
      difference = mean_difference(truth, queries[m], shadings[m].values());
      nanoseconds[m] += least[m] / std::size(roughnesses);
      apart[m] += difference / std::size(roughnesses);
    }
    largest = std::max(largest, difference);
  }
  ChartData data;
  for (std::size_t m = 0; m < std::size(models); ++m)
    data.series.push_back({models[m].name, {{nanoseconds[m], apart[m]}}});
  data.assertions = {
      {"all bounces: largest difference of a roughness, in just noticeable ones of 2.3",
       largest / 2.3, 1}};
  data.settings = {{"metal", "about gold's index of refraction, mean of roughness 0.3, 0.6, 1"},
                   {"lit", "by one light, both directions anywhere above"},
                   {"truth", "GGX, exact Fresnel, all bounces"},
                   {"time", "least of 7, in turn; with reading and writing 80 bytes"}};
  return data;
}

const Registration chart = register_chart({
    .name = "shading/models",
    .title = "Models of a metal's shading: time and colour",
    .x = {.label = "device time a value", .unit = "ns"},
    .y = {.label = "mean difference of colour", .unit = "CIELAB"},
    .produce = differences,
    .pareto = true,
});

}  // namespace
}  // namespace parity
