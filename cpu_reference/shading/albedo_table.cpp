#include "cpu_reference/shading/albedo_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cpu_reference/shading/brdf.h"

namespace parity::cpu {
namespace {

using std::numbers::pi;

/// Direction of cosine `cosine` in the plane of x and z.
dvec3 toward(double cosine) { return {std::sqrt(1 - cosine * cosine), 0, cosine}; }

/// A normal as the eye sees them, for (u, w) in the unit square: the stretched hemisphere is a disk
/// seen from v, of which the lower part is squeezed toward its middle.
dvec3 visible_normal(const dvec3& v, double alpha, double u, double w) {
  const dvec3 axis = glm::normalize(dvec3(alpha * v.x, alpha * v.y, v.z));
  const dvec3 first{0, 1, 0};
  const dvec3 second = glm::cross(axis, first);
  const double radius = std::sqrt(u);
  const double p = radius * std::cos(2 * pi * w);
  const double s = (1 + axis.z) / 2;
  const double q = (1 - s) * std::sqrt(1 - p * p) + s * radius * std::sin(2 * pi * w);
  const dvec3 h = p * first + q * second + std::sqrt(std::max(0.0, 1 - p * p - q * q)) * axis;
  return glm::normalize(dvec3(alpha * h.x, alpha * h.y, std::max(1e-9, h.z)));
}

double ggx_lambda(double alpha, double cosine) {
  const double tangent2 = (1 - cosine * cosine) / (cosine * cosine);
  return (std::sqrt(1 + alpha * alpha * tangent2) - 1) / 2;
}

/// Share of one visible normal: G2 / G1, in full and with Schlick's weight. u counts from the rim
/// of the disk, where the tail of the lobe is, and more densely there: the Jacobian is 2 u.
dvec2 visible_share(const dvec3& v, double alpha, double u, double w) {
  const dvec3 h = visible_normal(v, alpha, 1 - u * u, w);
  const double v_h = glm::dot(v, h);
  const dvec3 l = 2 * v_h * h - v;
  if (!(l.z > 0)) return dvec2(0.0);
  const double hidden = ggx_lambda(alpha, v.z);
  const double share = 2 * u * (1 + hidden) / (1 + hidden + ggx_lambda(alpha, l.z));
  return {share, share * std::pow(1 - std::clamp(v_h, 0.0, 1.0), 5)};
}

/// Sheen from one direction of light, times its cosine and the Jacobian of (u, w).
double sheen_share(const dvec3& v, double alpha, double u, double w) {
  const double cosine = 1 - u * u;
  const double sine = std::sqrt(1 - cosine * cosine);
  const dvec3 l{sine * std::cos(2 * pi * w), sine * std::sin(2 * pi * w), cosine};
  const dvec3 h = glm::normalize(l + v);
  const double sine2 = std::max(1e-7, 1 - h.z * h.z);
  const double d = (2 + 1 / alpha) * std::pow(sine2, 0.5 / alpha) / (2 * pi);
  return d / (4 * (l.z + v.z - l.z * v.z)) * cosine * 4 * pi * u;
}

dvec4 entry(double roughness, double cosine, double sheen_cosine, int samples) {
  const dvec3 v = toward(cosine), sheen_v = toward(sheen_cosine);
  const double alpha = roughness * roughness;
  dvec2 ggx{0.0};
  double sheen = 0;
  for (int j = 0; j < samples; ++j)
    for (int i = 0; i < samples; ++i) {
      const double u = (i + 0.5) / samples, w = (j + 0.5) / samples;
      ggx += visible_share(v, alpha, u, w);
      sheen += sheen_share(sheen_v, std::max(alpha, 0.04), u, w);
    }
  const double count = double(samples) * samples;
  const double less = std::pow(ggx.y / ggx.x, 0.2);  // 1 less the cosine of the mean weight
  return {ggx.x / count, std::max(1 - cosine - less, 0.0), 0, sheen / count};
}

double roughness_of(int row, int side) { return std::max(double(row) / (side - 1), 1.0 / 64); }

/// The inverse of the column that albedo_at reads.
double cosine_of(int column, int side, double alpha) {
  const double x2 = std::pow(double(column) / (side - 1), 2);
  return std::clamp(alpha * x2 / (1 + alpha - x2), 0.001 * alpha, 1.0);
}

/// 2 int E c dc of a row by 256 midpoints of c^2.
double mean_of(const Grid<dvec4>& table, int row) {
  Grid<vec4> one_row{table.width(), table.width()};
  for (int j = 0; j < table.width(); ++j)
    for (int i = 0; i < table.width(); ++i) one_row(i, j) = vec4(table(i, row));
  double sum = 0;
  for (int i = 0; i < 256; ++i) {
    const dvec3 e =
        albedo_at(one_row, std::sqrt((i + 0.5) / 256), roughness_of(row, table.width()));
    sum += e.x + e.y;
  }
  return sum / 256;
}

}  // namespace

DirectionalAlbedo directional_albedo(double alpha, double cosine, int n) {
  const dvec3 v = toward(cosine);
  double total = 0, weighted = 0;
  for (int i = 0; i < n; ++i) {
    const double left = 1 - (i + 0.5) / n;
    const double rest = left * left * left;  // the quantile is 1 - rest: the far tail counts
    const double tangent = alpha * std::sqrt((1 - rest) / rest);
    const double z = 1 / std::sqrt(1 + tangent * tangent);
    for (int j = 0; j < n / 2; ++j) {
      const double phi = pi * (j + 0.5) / (n / 2);
      const dvec3 h{tangent * z * std::cos(phi), tangent * z * std::sin(phi), z};
      const double v_h = glm::dot(v, h);
      const dvec3 l = 2 * v_h * h - v;
      if (!(v_h > 0) || !(l.z > 0)) continue;
      const double share = 3 * left * left * ggx_shadowing(l, v, dvec2(alpha)) * v_h / (v.z * h.z);
      total += share;
      weighted += share * std::pow(1 - v_h, 5);
    }
  }
  const double count = double(n) * (n / 2);
  return {(total - weighted) / count, weighted / count};
}

double sheen_albedo(double alpha, double cosine, int n) {
  const dvec3 v = toward(cosine);
  const auto weight = [n](int i) { return i == 0 || i == n ? 1.0 : (i % 2 == 0 ? 2.0 : 4.0); };
  double sum = 0;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      sum += weight(i) * weight(j) * sheen_share(v, alpha, double(i) / n, 0.5 * j / n);
  return sum / (9.0 * n * n);
}

Grid<dvec4> albedo_table(int side, int samples) {
  Grid<dvec4> table{side, side};
#pragma omp parallel for schedule(dynamic)
  for (int row = 0; row < side; ++row) {
    const double roughness = roughness_of(row, side);
    for (int column = 0; column < side; ++column)
      table(column, row) =
          entry(roughness, cosine_of(column, side, roughness * roughness),
                std::max(0.001, std::pow(double(column) / (side - 1), 2)), samples);
    const double mean = mean_of(table, row);
    for (int column = 0; column < side; ++column) table(column, row).z = std::sqrt(1 - mean);
  }
  return table;
}

}  // namespace parity::cpu
