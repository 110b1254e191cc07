#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "cpu_reference/shading/brdf.h"
#include "geometry/albedo_table.h"
#include "geometry/random.h"
#include "tests/numbers.h"

namespace parity {

inline auto fields_of(const BrdfQuery*) {
  return std::tuple{&BrdfQuery::to_light,   &BrdfQuery::to_eye, &BrdfQuery::color,
                    &BrdfQuery::absorption, &BrdfQuery::alpha,  &BrdfQuery::exponent,
                    &BrdfQuery::model,      &BrdfQuery::fresnel};
}

}  // namespace parity

/// Questions to BRDFs, and how far single precision may be from the answers.
namespace parity::shading_test {

struct BrdfProblem {
  std::vector<BrdfQuery> queries;
  Grid<vec4> albedo;
};
inline auto fields_of(const BrdfProblem*) {
  return std::tuple{&BrdfProblem::queries, &BrdfProblem::albedo};
}

/// Uniform over the directions at least `least` above the surface.
inline vec3 upward(Random& random, float least = 0.01f) {
  for (;;) {
    vec3 d = random.direction();
    d.z = std::abs(d.z);
    if (d.z >= least) return d;
  }
}

inline BrdfQuery microfacet_query(std::uint32_t model, double roughness, vec3 to_light,
                                  vec3 to_eye) {
  BrdfQuery q{};
  q.to_light = to_light;
  q.to_eye = to_eye;
  q.color = vec3(1.0f);
  q.alpha = vec2(float(roughness * roughness));
  q.model = model;
  q.fresnel = fresnel_schlick;
  return q;
}

constexpr double u = 0x1p-24;  ///< half a unit in the last place of 1

/// Bound of the microfacet models. A component of h is off by 6 u of itself (a correctly rounded
/// sum, a normalisation), so slope2 by 16 u of itself; D and the visibility are sums, products,
/// quotients (2.5 ULP) and roots of positive numbers, 80 u in all. 1 - v.h is off by 4 u, Fresnel
/// terms by 5 of that or, exact, by 32 u of 1. Beckmann: exp(-x) has x 16 u and 2 (3 + 2 x) u, and
/// Lambda 2e-6 of the error function's polynomial (1.5e-7 and rounding of terms up to 1.5).
/// Multiple scattering: entries are up to 1, their place is off by 16 u of 15 columns, so lost
/// shares by 400 u each.
inline dvec3 microfacet_bound(const BrdfQuery& q, const dvec3& value) {
  BrdfQuery white = q;
  white.color = vec3(1.0f);
  white.fresnel = fresnel_schlick;
  white.model = q.model == brdf_beckmann ? brdf_beckmann : brdf_ggx;
  const double lobe = cpu::brdf(white, {}).x;
  dvec3 bound = 80 * u * value + dvec3(32 * u * lobe);
  if (q.model == brdf_beckmann) {
    const dvec3 h = glm::normalize(dvec3(q.to_light) + dvec3(q.to_eye));
    const double x = (std::pow(h.x / q.alpha.x, 2) + std::pow(h.y / q.alpha.y, 2)) / (h.z * h.z);
    bound += lobe * ((20 * x + 6) * u + 4e-6);
  }
  if (q.model == brdf_ggx_multi_scatter) {
    const double roughness = std::sqrt(double(q.alpha.x));
    const auto lost = [&](double cosine) {
      const dvec3 e = cpu::albedo_at(albedo_table(), cosine, roughness);
      return std::max(0.0, 1 - e.x - e.y);
    };
    const double mean = cpu::albedo_at(albedo_table(), q.to_eye.z, roughness).z;
    bound += dvec3(400 * u * (lost(q.to_light.z) + lost(q.to_eye.z) + 400 * u) / (1 - mean));
  }
  return bound + dvec3(1e-30);
}

/// Bound of a power of a cosine: x^n = exp2(n log2 x). The cosine is off by 6 u, log2 by 2^-21, the
/// exponential by 3 + 2 |n log2 x| ULP; what stands around it by 8 u.
inline dvec3 power_bound(double cosine, double exponent, const dvec3& value) {
  if (!(cosine > 0)) return dvec3(cosine > -8 * u ? 1.0 : 0.0) + dvec3(1e-30);
  const double digits = std::abs(exponent * std::log2(cosine));
  return value * (exponent * (6 * u / cosine + 0x1p-21) + 2 * u * (3 + 2 * digits) + 8 * u) +
         dvec3(1e-30);
}

inline dvec3 phong_bound(const BrdfQuery& q, const dvec3& value) {
  const dvec3 l{q.to_light}, v{q.to_eye};
  if (q.model == brdf_lambert) return 4 * u * value;
  const bool blinn = q.model == brdf_blinn_phong || q.model == brdf_blinn_phong_normalized;
  const double cosine = blinn ? glm::normalize(l + v).z : v.z * l.z - v.x * l.x - v.y * l.y;
  return power_bound(cosine, q.exponent, value);
}

/// The sine squared of h is a sum of squares of components off by 6 u each.
inline dvec3 sheen_bound(const BrdfQuery& q, const dvec3& value) {
  const dvec3 h = glm::normalize(dvec3(q.to_light) + dvec3(q.to_eye));
  return power_bound(std::max(h.x * h.x + h.y * h.y, 1e-7), 0.5 / double(q.alpha.x), value) +
         40 * u * value;
}

inline dvec3 brdf_bound(const BrdfQuery& q, const dvec3& value) {
  if (q.model == brdf_sheen) return sheen_bound(q, value);
  return q.model < brdf_ggx ? phong_bound(q, value) : microfacet_bound(q, value);
}

/// Largest difference in units of each value's own bound.
inline double brdf_distance(const BrdfProblem& p, const std::vector<dvec3>& got,
                            const std::vector<dvec3>& want) {
  double worst = 0;
  for (std::size_t i = 0; i < want.size(); ++i) {
    const dvec3 bound = brdf_bound(p.queries[i], want[i]);
    for (int c = 0; c < 3; ++c)
      worst = std::max(worst, std::abs(got[i][c] - want[i][c]) / bound[c]);
  }
  return worst;
}

}  // namespace parity::shading_test
