#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "cpu_reference/shading/brdf.h"
#include "tests/shading/queries.h"

/// How much light comes back. A Brdf is a function of queries, so that both sides and wrong ones
/// can be asked.
namespace parity::shading_test {

using Brdf = std::function<std::vector<dvec3>(const std::vector<BrdfQuery>&)>;

inline Brdf on_cpu() {
  return [](const std::vector<BrdfQuery>& q) { return cpu::brdf(q, albedo_table()); };
}

inline vec3 toward(double cosine) { return vec3(dvec3(std::sqrt(1 - cosine * cosine), 0, cosine)); }

/// Directions of light and their weights for the integral of f cos over the hemisphere, n x n: half
/// vectors by the quantiles of an isotropic GGX of width `alpha`, the far tail more densely, so
/// that the peak is resolved however narrow it is.
struct WeightedLight {
  vec3 to_light;
  double weight;
};
inline std::vector<WeightedLight> lights_by_half_vector(const dvec3& v, double alpha, int n) {
  std::vector<WeightedLight> lights;
  for (int i = 0; i < n; ++i) {
    const double left = 1 - (i + 0.5) / n, rest = left * left * left;
    const double tangent = alpha * std::sqrt((1 - rest) / rest);
    const double z = 1 / std::sqrt(1 + tangent * tangent);
    for (int j = 0; j < n; ++j) {
      const double phi = 2 * std::numbers::pi * (j + 0.5) / n;
      const dvec3 h{tangent * z * std::cos(phi), tangent * z * std::sin(phi), z};
      const double v_h = glm::dot(v, h);
      const dvec3 l = 2 * v_h * h - v;
      if (!(v_h > 0) || !(l.z > 0)) continue;
      const double density = cpu::ggx_density(h, dvec2(alpha)) * h.z;
      lights.push_back({vec3(l), 3 * left * left * 4 * v_h * l.z / density / (double(n) * n)});
    }
  }
  return lights;
}

/// Part of white light from everywhere that comes back toward q.to_eye.
inline double returned(const Brdf& brdf, const BrdfQuery& q, double alpha, int n) {
  const std::vector<WeightedLight> lights = lights_by_half_vector(dvec3(q.to_eye), alpha, n);
  std::vector<BrdfQuery> queries(lights.size(), q);
  for (std::size_t i = 0; i < lights.size(); ++i) queries[i].to_light = lights[i].to_light;
  const std::vector<dvec3> values = brdf(queries);
  double sum = 0;
  for (std::size_t i = 0; i < lights.size(); ++i) sum += values[i].x * lights[i].weight;
  return sum;
}

/// White furnace: the largest |returned - 1| of a white surface over roughness 0.05 to 1 and
/// cosines 0.02 to 1.
inline double furnace_error(const Brdf& brdf, std::uint32_t model, int n) {
  double worst = 0;
  for (const double roughness : {0.05, 0.1, 0.12, 0.15, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 1.0})
    for (const double cosine : {0.02, 0.05, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0}) {
      const BrdfQuery q = microfacet_query(model, roughness, toward(1), toward(cosine));
      worst = std::max(worst, std::abs(returned(brdf, q, double(q.alpha.x), n) - 1));
    }
  return worst;
}

}  // namespace parity::shading_test
