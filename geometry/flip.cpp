#include "geometry/flip.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace parity {
namespace {

constexpr double pi = std::numbers::pi;

// Parameters of the paper's section 4.
constexpr double color_exponent = 0.7;     // q_c
constexpr double color_knee = 0.4;         // p_c
constexpr double color_knee_value = 0.95;  // p_t
constexpr double feature_width = 0.082;    // w, degrees
constexpr double feature_exponent = 0.5;   // q_f

// sRGB primaries and D65, row by row; exact fractions from the chromaticities.
const dmat3 xyz_from_rgb =
    glm::transpose(dmat3{10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0,
                         2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0,
                         1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0});
const dmat3 rgb_from_xyz = glm::inverse(xyz_from_rgb);
const dvec3 white = xyz_from_rgb * dvec3(1.0);

dvec3 ycxcz_from_rgb(dvec3 rgb) {
  const dvec3 t = xyz_from_rgb * rgb / white;
  return {116.0 * t.y - 16.0, 500.0 * (t.x - t.y), 200.0 * (t.y - t.z)};
}

dvec3 rgb_from_ycxcz(dvec3 c) {
  const double y = (c.x + 16.0) / 116.0;
  return rgb_from_xyz * (dvec3(y + c.y / 500.0, y, y - c.z / 200.0) * white);
}

double lab_curve(double t) {
  constexpr double delta = 6.0 / 29.0;
  return t > delta * delta * delta ? std::cbrt(t) : t / (3.0 * delta * delta) + 4.0 / 29.0;
}

/// L*a*b* with chroma that grows with lightness (Hunt effect).
dvec3 hunt_lab_from_rgb(dvec3 rgb) {
  const dvec3 t = xyz_from_rgb * rgb / white;
  const dvec3 f{lab_curve(t.x), lab_curve(t.y), lab_curve(t.z)};
  const double lightness = 116.0 * f.y - 16.0;
  return {lightness, 0.01 * lightness * 500.0 * (f.x - f.y),
          0.01 * lightness * 200.0 * (f.y - f.z)};
}

double hyab(dvec3 a, dvec3 b) {
  return std::abs(a.x - b.x) + glm::length(dvec2(a.y - b.y, a.z - b.z));
}

/// A filter along one axis, from -radius to radius.
using Filter = std::vector<double>;

int radius_of(const Filter& filter) { return int(filter.size()) / 2; }

/// Adds `weight` times `from` to `to`, element by element.
void add_scaled(std::span<double> to, const double* from, double weight) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += weight * from[i];
}

/// A row that goes on with its border for `radius` pixels on either side.
std::vector<double> padded_row(const Grid<double>& image, int y, int radius) {
  std::vector<double> row;
  row.reserve(std::size_t(image.width() + 2 * radius));
  for (int x = -radius; x < image.width() + radius; ++x)
    row.push_back(image(std::clamp(x, 0, image.width() - 1), y));
  return row;
}

/// Smaller pictures are done before the threads have met.
constexpr std::size_t worth_threads = 1u << 15;

/// Filters along x, then along y; beyond the border the picture goes on with its border.
Grid<double> filtered(const Grid<double>& image, const Filter& along_x, const Filter& along_y) {
  const int width = image.width(), height = image.height();
  Grid<double> rows{width, height}, result{width, height};
#pragma omp parallel for if (image.size() > worth_threads)
  for (int y = 0; y < height; ++y) {
    const std::vector<double> row = padded_row(image, y, radius_of(along_x));
    for (std::size_t i = 0; i < along_x.size(); ++i)
      add_scaled({&rows(0, y), std::size_t(width)}, row.data() + i, along_x[i]);
  }
#pragma omp parallel for if (image.size() > worth_threads)
  for (int y = 0; y < height; ++y) {
    const int radius = radius_of(along_y);
    for (int i = -radius; i <= radius; ++i)
      add_scaled({&result(0, y), std::size_t(width)}, &rows(0, std::clamp(y + i, 0, height - 1)),
                 along_y[std::size_t(i + radius)]);
  }
  return result;
}

Filter sampled(int radius, auto function) {
  Filter filter;
  for (int i = -radius; i <= radius; ++i) filter.push_back(function(double(i)));
  return filter;
}

double sum_of(const Filter& filter) { return std::accumulate(filter.begin(), filter.end(), 0.0); }

/// A channel's contrast sensitivity in the plane: a1 sqrt(pi / b1) exp(-pi^2 d^2 / b1) and the same
/// with a2, b2, where d is the distance in degrees.
struct Sensitivity {
  double a1, b1, a2, b2;
};
constexpr Sensitivity achromatic{1.0, 0.0047, 0.0, 1e-5};
constexpr Sensitivity red_green{1.0, 0.0053, 0.0, 1e-5};
constexpr Sensitivity blue_yellow{34.1, 0.04, 13.5, 0.025};
constexpr double widest = 0.04;

/// Filters a channel with its sensitivity, scaled so that a constant stays what it is.
Grid<double> seen(const Grid<double>& channel, const Sensitivity& s, double pixels_per_degree) {
  const int radius = int(std::ceil(3.0 * std::sqrt(widest / (2.0 * pi * pi)) * pixels_per_degree));
  const auto bell = [&](double b) {
    return sampled(radius, [&](double i) {
      const double d = i / pixels_per_degree;
      return std::exp(-pi * pi * d * d / b);
    });
  };
  const Filter first = bell(s.b1), second = bell(s.b2);
  const double weight_1 = s.a1 * std::sqrt(pi / s.b1), weight_2 = s.a2 * std::sqrt(pi / s.b2);
  const double total =
      weight_1 * sum_of(first) * sum_of(first) + weight_2 * sum_of(second) * sum_of(second);
  Grid<double> result = filtered(channel, first, first);
  for (double& value : result) value *= weight_1 / total;
  if (s.a2 == 0.0) return result;
  const Grid<double> rest = filtered(channel, second, second);
  for (std::size_t i = 0; i < rest.size(); ++i)
    result.values()[i] += rest.values()[i] * weight_2 / total;
  return result;
}

/// A picture in three planes.
struct Planes {
  Grid<double> channel[3];
};

Planes ycxcz_planes(const Grid<dvec3>& rgb) {
  Planes planes;
  for (Grid<double>& plane : planes.channel) plane = Grid<double>{rgb.width(), rgb.height()};
  for (std::size_t i = 0; i < rgb.size(); ++i) {
    const dvec3 color = ycxcz_from_rgb(rgb.values()[i]);
    for (int c = 0; c < 3; ++c) planes.channel[c].values()[i] = color[c];
  }
  return planes;
}

/// What the eye resolves of a picture, as Hunt-adjusted L*a*b*.
Grid<dvec3> perceived(const Planes& planes, double pixels_per_degree) {
  const Grid<double> y = seen(planes.channel[0], achromatic, pixels_per_degree);
  const Grid<double> cx = seen(planes.channel[1], red_green, pixels_per_degree);
  const Grid<double> cz = seen(planes.channel[2], blue_yellow, pixels_per_degree);
  Grid<dvec3> lab{y.width(), y.height()};
#pragma omp parallel for if (lab.size() > worth_threads)
  for (std::size_t i = 0; i < lab.size(); ++i) {
    const dvec3 rgb = rgb_from_ycxcz({y.values()[i], cx.values()[i], cz.values()[i]});
    lab.values()[i] = hunt_lab_from_rgb(glm::clamp(rgb, 0.0, 1.0));
  }
  return lab;
}

/// The distance of two colours, 0 to 1: most of the range for the smaller ones.
double color_error(dvec3 a, dvec3 b) {
  static const double largest =
      std::pow(hyab(hunt_lab_from_rgb({0, 1, 0}), hunt_lab_from_rgb({0, 0, 1})), color_exponent);
  const double error = std::pow(hyab(a, b), color_exponent);
  const double knee = color_knee * largest;
  if (error < knee) return color_knee_value / knee * error;
  return color_knee_value + (error - knee) / (largest - knee) * (1.0 - color_knee_value);
}

/// Scales what is positive to a sum of 1 and what is negative to -1, given that the other axis has
/// the sum `across`.
Filter balanced(Filter filter, double across) {
  double positive = 0.0, negative = 0.0;
  for (double weight : filter) (weight > 0.0 ? positive : negative) += std::abs(weight) * across;
  for (double& weight : filter) weight /= weight > 0.0 ? positive : negative > 0.0 ? negative : 1.0;
  return filter;
}

/// How strongly a pixel is on an edge, and how strongly it is a point.
struct Features {
  Grid<double> edge;
  Grid<double> point;
};

Grid<double> length_of(const Grid<double>& x, const Grid<double>& y) {
  Grid<double> length{x.width(), x.height()};
  for (std::size_t i = 0; i < length.size(); ++i)
    length.values()[i] = glm::length(dvec2(x.values()[i], y.values()[i]));
  return length;
}

/// Gradient and second derivative of the lightness through a Gaussian half a feature wide.
Features features_of(Grid<double> lightness, double pixels_per_degree) {
  for (double& value : lightness) value = (value + 16.0) / 116.0;
  const double sigma = 0.5 * feature_width * pixels_per_degree;
  const int radius = int(std::ceil(3.0 * sigma));
  const auto bell = [&](double i) { return std::exp(-i * i / (2.0 * sigma * sigma)); };
  const Filter gauss = sampled(radius, bell);
  const Filter first =
      balanced(sampled(radius, [&](double i) { return -i * bell(i); }), sum_of(gauss));
  const Filter second =
      balanced(sampled(radius, [&](double i) { return (i * i / (sigma * sigma) - 1.0) * bell(i); }),
               sum_of(gauss));
  return {length_of(filtered(lightness, first, gauss), filtered(lightness, gauss, first)),
          length_of(filtered(lightness, second, gauss), filtered(lightness, gauss, second))};
}

void check_sizes(const Grid<vec4>& a, const Grid<vec4>& b, double pixels_per_degree) {
  if (a.width() != b.width() || a.height() != b.height() || a.empty())
    throw std::invalid_argument("flip: sizes are " + std::to_string(a.width()) + "x" +
                                std::to_string(a.height()) + " and " + std::to_string(b.width()) +
                                "x" + std::to_string(b.height()) + ", must be equal and not 0");
  if (!(pixels_per_degree >= 1.0 && pixels_per_degree <= 1000.0))
    throw std::invalid_argument("flip: pixels_per_degree is " + std::to_string(pixels_per_degree) +
                                ", must be in [1, 1000]");
}

/// RGB in [0, largest]; what is no number becomes 0.
Grid<dvec3> clamped(const Grid<vec4>& image, double largest) {
  Grid<dvec3> result{image.width(), image.height()};
  for (std::size_t i = 0; i < image.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double value = double(image.values()[i][c]);
      result.values()[i][c] = value > 0.0 ? std::min(value, largest) : 0.0;
    }
  return result;
}

Grid<float> flip_of_clamped(const Grid<dvec3>& reference, const Grid<dvec3>& test,
                            double pixels_per_degree) {
  const Planes a = ycxcz_planes(reference), b = ycxcz_planes(test);
  const Grid<dvec3> color_a = perceived(a, pixels_per_degree);
  const Grid<dvec3> color_b = perceived(b, pixels_per_degree);
  const Features features_a = features_of(a.channel[0], pixels_per_degree);
  const Features features_b = features_of(b.channel[0], pixels_per_degree);
  Grid<float> errors{reference.width(), reference.height()};
#pragma omp parallel for if (errors.size() > worth_threads)
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double edge = std::abs(features_a.edge.values()[i] - features_b.edge.values()[i]);
    const double point = std::abs(features_a.point.values()[i] - features_b.point.values()[i]);
    const double feature = std::pow(std::max(edge, point) / std::numbers::sqrt2, feature_exponent);
    const double color = color_error(color_a.values()[i], color_b.values()[i]);
    errors.values()[i] = float(std::pow(color, 1.0 - feature));
  }
  return errors;
}

// The ACES curve (p0 x^2 + p1 x) / (p3 x^2 + p4 x + p5), its exposure of 0.6 taken in.
constexpr double p0 = 0.6 * 0.6 * 2.51, p1 = 0.6 * 0.03;
constexpr double p3 = 0.6 * 0.6 * 2.43, p4 = 0.6 * 0.59, p5 = 0.14;
constexpr double shown_as = 0.85;
constexpr int most_exposures = 32;

double tone_mapped(double x) {
  return std::clamp((p0 * x * x + p1 * x) / (p3 * x * x + p4 * x + p5), 0.0, 1.0);
}

/// The value that the curve takes to t: the larger root of a quadratic equation.
double inverse_tone_mapped(double t) {
  const double a = p0 - t * p3, b = p1 - t * p4, c = -t * p5;
  return (-b + std::sqrt(b * b - 4.0 * a * c)) / (2.0 * a);
}

Grid<dvec3> exposed(const Grid<dvec3>& image, double exposure) {
  const double factor = std::exp2(exposure);
  Grid<dvec3> result{image.width(), image.height()};
  for (std::size_t i = 0; i < image.size(); ++i)
    for (int c = 0; c < 3; ++c) result.values()[i][c] = tone_mapped(factor * image.values()[i][c]);
  return result;
}

}  // namespace

Grid<float> flip(const Grid<vec4>& reference, const Grid<vec4>& test, double pixels_per_degree) {
  check_sizes(reference, test, pixels_per_degree);
  return flip_of_clamped(clamped(reference, 1.0), clamped(test, 1.0), pixels_per_degree);
}

ExposureRange exposure_range(const Grid<vec4>& reference) {
  std::vector<double> luminances;
  for (const vec4& color : reference) {
    const double y = 0.2126 * color.x + 0.7152 * color.y + 0.0722 * color.z;
    if (std::isfinite(y) && y > 0.0) luminances.push_back(y);
  }
  if (luminances.empty()) return {};
  const auto middle = luminances.begin() + std::ptrdiff_t((luminances.size() - 1) / 2);
  std::nth_element(luminances.begin(), middle, luminances.end());
  const double median = *middle;
  const double brightest = *std::max_element(middle, luminances.end());
  const double shown = inverse_tone_mapped(shown_as);
  ExposureRange range{std::log2(shown / brightest), std::log2(shown / median), 2};
  range.count = std::clamp(int(std::ceil(range.stop - range.start)), 2, most_exposures);
  return range;
}

Grid<float> hdr_flip(const Grid<vec4>& reference, const Grid<vec4>& test,
                     double pixels_per_degree) {
  check_sizes(reference, test, pixels_per_degree);
  const ExposureRange range = exposure_range(reference);
  const Grid<dvec3> a = clamped(reference, 1e30), b = clamped(test, 1e30);
  Grid<float> errors{reference.width(), reference.height(), 0.0f};
  for (int i = 0; i < range.count; ++i) {
    const double part = range.count > 1 ? double(i) / double(range.count - 1) : 0.0;
    const double exposure = range.start + part * (range.stop - range.start);
    const Grid<float> at =
        flip_of_clamped(exposed(a, exposure), exposed(b, exposure), pixels_per_degree);
    for (std::size_t p = 0; p < errors.size(); ++p)
      errors.values()[p] = std::max(errors.values()[p], at.values()[p]);
  }
  return errors;
}

double mean(const Grid<float>& errors) {
  if (errors.empty()) return 0.0;
  return std::accumulate(errors.begin(), errors.end(), 0.0) / double(errors.size());
}

Grid<u8vec4> magma(const Grid<float>& values) {
  constexpr double coefficients[3][7] = {
      {-0.002136485053939582, 0.2516605407371642, 8.353717279216625, -27.66873308576866,
       52.17613981234068, -50.76852536473588, 18.65570506591883},
      {-0.000749655052795221, 0.6775232436837668, -3.577719514958484, 14.26473078096533,
       -27.94360607168351, 29.04658282127291, -11.48977351997711},
      {-0.005386127855323933, 2.494026599312351, 0.3144679030132573, -13.64921318813922,
       12.94416944238394, 4.23415299384598, -5.601961508734096}};
  Grid<u8vec4> colors{values.width(), values.height(), u8vec4(255)};
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double t = values.values()[i] > 0.0f ? std::min(double(values.values()[i]), 1.0) : 0.0;
    for (int c = 0; c < 3; ++c) {
      double value = 0.0;
      for (int power = 6; power >= 0; --power) value = value * t + coefficients[c][power];
      colors.values()[i][c] = std::uint8_t(std::lround(255.0 * std::clamp(value, 0.0, 1.0)));
    }
  }
  return colors;
}

}  // namespace parity
