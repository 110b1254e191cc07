// Filters along footprints: their axes, and the elliptical average that judges them.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "cpu_reference/texture/anisotropic.h"
#include "cpu_reference/texture/mip_pyramid.h"
#include "tests/texture/textures.h"

namespace parity {
namespace {

TEST(Anisotropic, AxesAreThoseOfTheEllipse) {
  const cpu::FootprintAxes turned = cpu::footprint_axes({0.3, 0.4}, {-0.08, 0.06}, 10, 10);
  EXPECT_NEAR(turned.major, 5, 1e-12);
  EXPECT_NEAR(turned.minor, 1, 1e-12);
  EXPECT_NEAR(std::abs(glm::dot(turned.direction, dvec2(0.6, 0.8))), 1, 1e-12);
  // A shear: singular values of [[1, 1], [0, 1]] are the golden ratio and its inverse.
  const cpu::FootprintAxes sheared = cpu::footprint_axes({1, 0}, {1, 1}, 1, 1);
  EXPECT_NEAR(sheared.major, (1 + std::sqrt(5.0)) / 2, 1e-12);
  EXPECT_NEAR(sheared.minor, (std::sqrt(5.0) - 1) / 2, 1e-12);
}

std::vector<Grid<u8vec4>> random_pyramid() {
  Random random{9};
  return cpu::mip_pyramid(texture_test::random_image(64, 64, random), false);
}

TEST(Anisotropic, KeepsAConstantAndIsContinuous) {
  const std::vector<Grid<u8vec4>> flat = cpu::mip_pyramid(Grid<u8vec4>{64, 64, u8vec4(77)}, false);
  const std::vector<Grid<u8vec4>> noise = random_pyramid();
  for (double size = 0.5; size < 40; size *= 1.01) {
    const cpu::Footprint f{{0.3, 0.4}, dvec2(6, 2) * size / 640.0, dvec2(-1, 2) * size / 640.0};
    cpu::Footprint next = f;
    next.dx *= 1 + 1e-7;
    next.dy *= 1 + 1e-7;
    const auto at = [&](const auto& levels, const cpu::Footprint& footprint) {
      return cpu::sample({levels, false, {.max_anisotropy = 8}}, footprint).value.x;
    };
    EXPECT_NEAR(at(flat, f), 77 / 255.0, 1e-12);
    // Level weights change by 4 a level, 1e-7 / ln 2 levels; ellipses by 2e-7 of up to 40 texels.
    EXPECT_NEAR(at(noise, f), at(noise, next), 2e-5) << size;
  }
}

/// The Fourier transform of exp(-2 r^2) - exp(-2) on the unit disc, over its integral, at angular
/// frequency s. By parts, integral of r^(n+1) exp(-2 r^2) J_n(s r) = exp(-2) J_(n+1)(s) / s + 4 / s
/// times the next; the first of these terms is what exp(-2) takes away.
double disc_spectrum(double s) {
  if (s < 1e-6) return 1;
  double sum = 0, factor = std::exp(-2.0) / s;
  for (int n = 1; n < 64; ++n) {
    factor *= 4 / s;
    const double term = factor * std::cyl_bessel_j(n + 1, s);
    sum += term;
    if (std::abs(term) < 1e-15 || (s > 8 && factor < 1e-9)) break;
  }
  return sum / ((1 - 3 * std::exp(-2.0)) / 4);
}

/// The weights of an ellipse of a footprint, in frequency: J J^T + I applied to a frequency, not
/// its axes. Frequencies in cycles a texel.
struct EllipseSpectrum {
  glm::dmat2 matrix{1.0};
  EllipseSpectrum(dvec2 dx, dvec2 dy)
      : matrix(glm::outerProduct(dx, dx) + glm::outerProduct(dy, dy) + glm::dmat2(1.0)) {}
  double at(dvec2 k) const {
    return disc_spectrum(2 * std::numbers::pi * std::sqrt(glm::dot(k, matrix * k)));
  }
  /// Square of the shorter half axis.
  double least() const {
    const double mean = (matrix[0][0] + matrix[1][1]) / 2;
    return mean - std::hypot((matrix[0][0] - matrix[1][1]) / 2, matrix[0][1]);
  }
};

/// The weighted sum of exp(2 pi i k x) over texels' centres, weights around `place`, by Poisson's
/// sum over the lattice of frequencies up to `reach`, over the integral of the weights.
std::complex<double> lattice_sum(const EllipseSpectrum& spectrum, dvec2 k, dvec2 place, int reach) {
  std::complex<double> sum = 0;
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x) {
      if (x * x + y * y > reach * reach) continue;
      const dvec2 q = dvec2(x, y) - k;
      const double sign = (x + y) % 2 == 0 ? 1 : -1;
      sum += sign * spectrum.at(q) * std::polar(1.0, -2 * std::numbers::pi * glm::dot(q, place));
    }
  return sum;
}

TEST(EllipticalAverage, DampsAWaveByTheSpectrumOfItsEllipse) {
  constexpr int width = 64, height = 32, reach = 16;
  const dvec2 size{width, height};
  const std::pair<dvec2, dvec2> footprints[] = {// texels
                                                {{3, 1}, {-1, 2}},
                                                {{9, 4}, {-1, 2}},
                                                {{0, -6}, {6, 0}},
                                                {{2, 2}, {4, 4}}};
  for (const ivec2 cycles : {ivec2(3, 0), ivec2(0, 2), ivec2(5, 3), ivec2(4, -2), ivec2(8, 4)}) {
    const dvec2 k = dvec2(cycles) / size;
    Grid<u8vec4> wave{width, height};
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        wave(x, y).x = std::uint8_t(std::lround(
            127.5 + 127.5 * std::cos(2 * std::numbers::pi * glm::dot(k, dvec2(x, y) + 0.5))));
    const std::vector<Grid<u8vec4>> levels{wave};
    for (const auto& [dx, dy] : footprints) {
      const EllipseSpectrum spectrum(dx, dy);
      const dvec2 place{21.3, 7.9};
      const double want = 0.5 + 0.5 * (lattice_sum(spectrum, k, place, reach) /
                                       lattice_sum(spectrum, {0, 0}, place, reach))
                                          .real();
      // Left out: |spectrum| at s is at most 4 exp(-2) sqrt(2 / pi s) / s^2 / 0.1485 to leading
      // order, s at least 2 pi a shorter half axis; over all frequencies beyond reach, in both
      // sums, times a half. A texel is rounded by half a code.
      const double scale = 2 * std::numbers::pi * std::sqrt(spectrum.least());
      const double left_out = 4 * std::exp(-2.0) * std::sqrt(2 / std::numbers::pi) / 0.1485 *
                              std::pow(scale, -2.5) * 2 * std::numbers::pi * 2 / std::sqrt(reach);
      const double got = cpu::elliptical_weighted_average({levels, false, {}},
                                                          {place / size, dx / size, dy / size})
                             .x;
      EXPECT_NEAR(got, want, left_out + 0.5 / 255) << cycles.x << " " << cycles.y << " " << dx.x;
      // Without the lattice: its four nearest copies at s > 16 are below 0.0025 each, as above.
      const double wave_there = std::cos(2 * std::numbers::pi * glm::dot(k, place));
      if (scale > 20) {
        EXPECT_NEAR(got, 0.5 + 0.5 * wave_there * spectrum.at(k), 0.01);
      }
    }
  }
}

TEST(EllipticalAverage, KeepsAConstant) {
  const std::vector<Grid<u8vec4>> flat{Grid<u8vec4>{40, 24, u8vec4(77)}};
  for (const double size : {0.0, 0.3, 2.0, 30.0})  // texels; the ellipse has always one inside
    for (const double ratio : {0.0, 0.1, 1.0}) {
      const cpu::Footprint f{{0.31, 0.87},
                             size * dvec2(0.6 / 40, 0.8 / 24),
                             ratio * size * dvec2(-0.8 / 40, 0.6 / 24)};
      const dvec4 got = cpu::elliptical_weighted_average({flat, false, {}}, f);
      for (int c = 0; c < 4; ++c) EXPECT_NEAR(got[c], 77 / 255.0, 1e-12);
    }
}

/// The weighted mean of texels, as squares, over the ellipse d (J J^T + I)^-1 d < 1, by 16 x 16
/// points a texel.
double supersampled(const Grid<u8vec4>& image, dvec2 place, dvec2 dx, dvec2 dy) {
  const glm::dmat2 conic =
      glm::inverse(glm::outerProduct(dx, dx) + glm::outerProduct(dy, dy) + glm::dmat2(1.0));
  const int reach = 2 + int(std::ceil(std::sqrt(glm::dot(dx, dx) + glm::dot(dy, dy))));
  double sum = 0, weights = 0;
  for (double y = std::floor(place.y) - reach + 1 / 32.0; y < place.y + reach; y += 1 / 16.0)
    for (double x = std::floor(place.x) - reach + 1 / 32.0; x < place.x + reach; x += 1 / 16.0) {
      const dvec2 d = dvec2(x, y) - place;
      const double weight = std::exp(-2 * glm::dot(d, conic * d)) - std::exp(-2.0);
      if (weight <= 0) continue;
      const auto wrapped = [](double c, int size) {
        return (int(std::floor(c)) % size + size) % size;
      };
      sum += weight * image(wrapped(x, image.width()), wrapped(y, image.height())).x / 255.0;
      weights += weight;
    }
  return sum / weights;
}

TEST(EllipticalAverage, IsWhatManyPointsInTheEllipseGive) {
  Random random{6};
  const Grid<u8vec4> blocks = texture_test::random_image(7, 5, random);
  std::vector<Grid<u8vec4>> levels{Grid<u8vec4>{42, 30}};
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 42; ++x) levels[0](x, y) = blocks(x / 6, y / 6);
  const dvec2 size{42, 30};
  for (int i = 0; i < 40; ++i) {
    const double turn = random.uniform(0.0f, 6.28f);
    const dvec2 along{std::cos(turn), std::sin(turn)}, across{-along.y, along.x};
    const double a = 12, b = 6;
    const double lean = random.uniform(-1.0f, 1.0f);  // a rotation of the pixel changes nothing
    const dvec2 dx = a * std::cos(lean) * along + b * std::sin(lean) * across;
    const dvec2 dy = -a * std::sin(lean) * along + b * std::cos(lean) * across;
    const dvec2 place{random.uniform(0, 42), random.uniform(0, 30)};
    const double got =
        cpu::elliptical_weighted_average({levels, false, {}}, {place / size, dx / size, dy / size})
            .x;
    // A texel's weight is that of its middle, off from its mean by (4 / a^2 + 4 / b^2) / 24 inside
    // (second derivatives of exp(-2 r^2) are at most 4) and by a quarter of the slope 4 exp(-2) / b
    // on the border, which crosses at most 4 (a + b) + 4 texels; over the sum of weights, 0.933 a
    // b. Texels are within 1/2 of 1/2, and so is the error of the sum of weights.
    const double inside = std::numbers::pi * a * b * (4 / (a * a) + 4 / (b * b)) / 24;
    const double border = std::exp(-2.0) / b * (4 * (a + b) + 4);
    EXPECT_NEAR(got, supersampled(levels[0], place, dx, dy), (inside + border) / (0.933 * a * b));
  }
}

TEST(Anisotropic, IsSharperThanTrilinearAlongTheShortAxis) {
  // Stripes of two texels along x; the footprint is 16 long in x and 1 wide in y.
  Grid<u8vec4> stripes{64, 64};
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) stripes(x, y) = u8vec4(y / 4 % 2 == 0 ? 255 : 0);
  const auto levels = cpu::mip_pyramid(stripes, false);
  const cpu::Footprint f{{0.5, 2.0 / 64}, {16.0 / 64, 0}, {0, 1.0 / 64}};
  const double truth = cpu::elliptical_weighted_average({levels, false, {}}, f).x;
  EXPECT_GT(truth, 0.99);
  EXPECT_NEAR(cpu::sample({levels, false, {.max_anisotropy = 16}}, f).value.x, truth, 0.03);
  EXPECT_NEAR(cpu::sample({levels, false, {}}, f).value.x, 0.5, 0.01);
}

}  // namespace
}  // namespace parity
