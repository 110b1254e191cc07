#include "cpu_reference/shading/brdf.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace parity::cpu {
namespace {

using std::numbers::pi;

/// (tan theta cos phi / alpha.x)^2 + (tan theta sin phi / alpha.y)^2
double stretched_tangent2(const dvec3& h, const dvec2& alpha) {
  return (h.x * h.x / (alpha.x * alpha.x) + h.y * h.y / (alpha.y * alpha.y)) / (h.z * h.z);
}

/// 1 / (tan theta times the width of the distribution along the direction); infinite for the
/// normal.
double slope_ratio(const dvec3& d, const dvec2& alpha) {
  return d.z / std::hypot(alpha.x * d.x, alpha.y * d.y);
}

double ggx_lambda(double a) { return 0.5 * (std::sqrt(1 + 1 / (a * a)) - 1); }

double beckmann_lambda(double a) {
  if (std::isinf(a)) return 0;
  return 0.5 * (std::exp(-a * a) / (a * std::sqrt(pi)) - std::erfc(a));
}

dvec3 fresnel(const BrdfQuery& q, double cosine) {
  dvec3 f;
  for (int i = 0; i < 3; ++i) {
    if (q.fresnel == fresnel_schlick)
      f[i] = fresnel_schlick_of(q.color[i], cosine);
    else
      f[i] = q.fresnel == fresnel_dielectric ? fresnel_exact(q.color.x, 0, cosine)
                                             : fresnel_exact(q.color[i], q.absorption[i], cosine);
  }
  return f;
}

dvec3 cook_torrance(const BrdfQuery& q, const dvec3& l, const dvec3& v) {
  const dvec3 h = glm::normalize(l + v);
  const dvec2 alpha{q.alpha};
  const bool beckmann = q.model == brdf_beckmann;
  const double d = beckmann ? beckmann_density(h, alpha) : ggx_density(h, alpha);
  const double g = beckmann ? beckmann_shadowing(l, v, alpha) : ggx_shadowing(l, v, alpha);
  return fresnel(q, glm::dot(l, h)) * (d * g / (4 * l.z * v.z));
}

dvec4 between_nodes(const Grid<vec4>& table, double x, double y) {
  const int last = table.width() - 1;
  const int i = std::min(int(x), last - 1), j = std::min(int(y), last - 1);
  dvec4 sum{0.0};
  for (int below = 0; below < 2; ++below)
    for (int right = 0; right < 2; ++right)
      sum += dvec4(table(i + right, j + below)) * (1 - std::abs(x - i - right)) *
             (1 - std::abs(y - j - below));
  return sum;
}

/// The lobe that multiple scattering adds: what is missing from either direction, scaled so that a
/// white surface reflects everything.
dvec3 bounced_lobe(const BrdfQuery& q, const Grid<vec4>& table) {
  const double roughness = std::sqrt(double(q.alpha.x));
  const dvec3 toward_light = albedo_at(table, q.to_light.z, roughness);
  const dvec3 toward_eye = albedo_at(table, q.to_eye.z, roughness);
  const double mean = toward_eye.z;
  const double lobe = (1 - toward_light.x - toward_light.y) * (1 - toward_eye.x - toward_eye.y) /
                      (pi * std::max(1 - mean, 1e-6));
  dvec3 sum;
  for (int i = 0; i < 3; ++i) {
    const double f = (1 + 20 * double(q.color[i])) / 21;
    sum[i] = lobe * f * f * mean / (1 - f * (1 - mean));
  }
  return sum;
}

double phong(const BrdfQuery& q, const dvec3& l, const dvec3& v) {
  const bool blinn = q.model == brdf_blinn_phong || q.model == brdf_blinn_phong_normalized;
  const dvec3 n{0, 0, 1};
  const double cosine =
      blinn ? glm::dot(n, glm::normalize(l + v)) : glm::dot(v, 2 * glm::dot(n, l) * n - l);
  const double lobe = cosine > 0 ? std::pow(cosine, double(q.exponent)) : 0.0;
  if (q.model == brdf_phong_normalized) return lobe * (q.exponent + 2.0) / (2 * pi);
  const double e = q.exponent;
  if (q.model == brdf_blinn_phong_normalized)
    return lobe * (e + 2) * (e + 4) / (8 * pi * (std::exp2(-e / 2) + e));
  return lobe;
}

double charlie(const dvec3& l, const dvec3& v, double alpha) {
  const dvec3 h = glm::normalize(l + v);
  const double sine2 = std::max(h.x * h.x + h.y * h.y, 1e-7);
  const double d = (2 + 1 / alpha) * std::pow(std::sqrt(sine2), 1 / alpha) / (2 * pi);
  return d / (4 * (l.z + v.z - l.z * v.z));
}

}  // namespace

double fresnel_schlick_of(double f0, double cosine) {
  return f0 + (1 - f0) * std::pow(1 - std::clamp(cosine, 0.0, 1.0), 5);
}

double fresnel_exact(double eta, double k, double cosine) {
  const double c = std::clamp(cosine, 0.0, 1.0);
  const std::complex<double> index{eta, k};
  const std::complex<double> t = std::sqrt(1.0 - (1 - c * c) / (index * index));
  const std::complex<double> s_wave = (c - index * t) / (c + index * t);
  const std::complex<double> p_wave = (index * c - t) / (index * c + t);
  return 0.5 * (std::norm(s_wave) + std::norm(p_wave));
}

double ggx_density(const dvec3& h, const dvec2& alpha) {
  if (!(h.z > 0)) return 0;
  const double spread = 1 + stretched_tangent2(h, alpha);
  return 1 / (pi * alpha.x * alpha.y * std::pow(h.z, 4) * spread * spread);
}

double beckmann_density(const dvec3& h, const dvec2& alpha) {
  if (!(h.z > 0)) return 0;
  return std::exp(-stretched_tangent2(h, alpha)) / (pi * alpha.x * alpha.y * std::pow(h.z, 4));
}

double ggx_shadowing(const dvec3& l, const dvec3& v, const dvec2& alpha) {
  return 1 / (1 + ggx_lambda(slope_ratio(l, alpha)) + ggx_lambda(slope_ratio(v, alpha)));
}

double beckmann_shadowing(const dvec3& l, const dvec3& v, const dvec2& alpha) {
  return 1 / (1 + beckmann_lambda(slope_ratio(l, alpha)) + beckmann_lambda(slope_ratio(v, alpha)));
}

dvec3 albedo_at(const Grid<vec4>& table, double cosine, double roughness) {
  const int last = table.width() - 1;
  const double bounded = std::clamp(roughness, 1.0 / 64, 1.0);
  const double alpha = bounded * bounded;
  const double c = std::clamp(cosine, 1e-6, 1.0);
  const dvec4 entry =
      between_nodes(table, std::sqrt((1 + alpha) / (1 + alpha / c)) * last, bounded * last);
  const double grazing = std::pow(1 - std::min(c + entry.y, 1.0), 5);
  return {entry.x * (1 - grazing), entry.x * grazing, 1 - entry.z * entry.z};
}

double sheen_albedo_at(const Grid<vec4>& table, double cosine, double roughness) {
  const int last = table.width() - 1;
  return between_nodes(table, std::sqrt(std::clamp(cosine, 0.0, 1.0)) * last,
                       std::clamp(roughness, 0.2, 1.0) * last)
      .w;
}

dvec3 brdf(const BrdfQuery& q, const Grid<vec4>& albedo) {
  const dvec3 l{q.to_light}, v{q.to_eye};
  if (!(l.z > 0) || !(v.z > 0)) return dvec3(0.0);
  switch (q.model) {
    case brdf_lambert:
      return dvec3(q.color) / pi;
    case brdf_ggx:
    case brdf_beckmann:
      return cook_torrance(q, l, v);
    case brdf_ggx_multi_scatter:
      return cook_torrance(q, l, v) + bounced_lobe(q, albedo);
    case brdf_sheen:
      return dvec3(q.color) * charlie(l, v, double(q.alpha.x));
    default:
      return dvec3(q.color) * phong(q, l, v);
  }
}

std::vector<dvec3> brdf(std::span<const BrdfQuery> queries, const Grid<vec4>& albedo) {
  std::vector<dvec3> values;
  values.reserve(queries.size());
  for (const BrdfQuery& query : queries) values.push_back(brdf(query, albedo));
  return values;
}

}  // namespace parity::cpu
