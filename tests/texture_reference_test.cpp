#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <set>
#include <vector>

#include "cpu_reference/texture/anisotropic.h"
#include "cpu_reference/texture/answers.h"
#include "cpu_reference/texture/environment.h"
#include "cpu_reference/texture/mip_pyramid.h"
#include "cpu_reference/texture/procedural.h"
#include "cpu_reference/texture/projection.h"
#include "cpu_reference/texture/sample.h"
#include "cpu_reference/texture/surface_detail.h"
#include "cpu_reference/texture/texel.h"
#include "gpu/texture/displacement.h"
#include "gpu/texture/sample.h"
#include "tests/gpu_context.h"
#include "tests/texture/errata_texture.h"
#include "tests/texture/textures.h"

namespace parity {
namespace {

using cpu::MippedTexture;

/// Red of texel (x, y) is 10 (x + 4 y).
std::vector<Grid<u8vec4>> ramp() {
  Grid<u8vec4> image{4, 4};
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) image(x, y) = u8vec4(u8vec4::value_type(10 * (x + 4 * y)));
  return {image};
}

double code(const MippedTexture& t, double u, double v, double lambda = 0) {
  return cpu::sample(t, {u, v}, lambda).value.x * 255.0;
}

Sampler sampler(Wrap wrap, Filter filter) {
  return {.wrap_u = wrap, .wrap_v = wrap, .mag = filter, .min = filter, .mip = {}};
}

// Sums of four products of doubles around 100: 1e-12.
constexpr double rounding = 1e-12;

TEST(CpuTexture, NearestTakesTheTexelThatHoldsThePoint) {
  const auto levels = ramp();
  const MippedTexture t{levels, false, sampler(Wrap::repeat, Filter::nearest)};
  EXPECT_NEAR(code(t, 0.24, 0.0), 0, rounding);
  EXPECT_NEAR(code(t, 0.25, 0.0), 10, rounding);
  EXPECT_NEAR(code(t, 0.99, 0.99), 150, rounding);
}

TEST(CpuTexture, WrapsByItsMode) {
  const auto levels = ramp();
  const MippedTexture repeat{levels, false, sampler(Wrap::repeat, Filter::nearest)};
  EXPECT_NEAR(code(repeat, -0.1, 0.1), 30, rounding);
  EXPECT_NEAR(code(repeat, 5.3, 0.1), 10, rounding);
  const MippedTexture mirror{levels, false, sampler(Wrap::mirrored_repeat, Filter::nearest)};
  EXPECT_NEAR(code(mirror, -0.1, 0.1), 0, rounding);
  EXPECT_NEAR(code(mirror, 1.1, 0.1), 30, rounding);
  EXPECT_NEAR(code(mirror, -1.1, 0.1), 30, rounding);
  EXPECT_NEAR(code(mirror, 2.3, 0.1), 10, rounding);
  const MippedTexture clamp{levels, false, sampler(Wrap::clamp_to_edge, Filter::nearest)};
  EXPECT_NEAR(code(clamp, -7, 0.1), 0, rounding);
  EXPECT_NEAR(code(clamp, 7, 0.1), 30, rounding);
  const MippedTexture once{levels, false, sampler(Wrap::mirror_clamp_to_edge, Filter::nearest)};
  EXPECT_NEAR(code(once, -0.1, 0.1), 0, rounding);
  EXPECT_NEAR(code(once, -0.6, 0.1), 20, rounding);
  EXPECT_NEAR(code(once, -7, 0.1), 30, rounding) << "the mirrored far edge";
  EXPECT_NEAR(code(once, 7, 0.1), 30, rounding);
}

TEST(CpuTexture, ABorderIsTransparentBlack) {
  const auto levels = ramp();
  const MippedTexture nearest{levels, false, sampler(Wrap::clamp_to_border, Filter::nearest)};
  for (const dvec2 outside : {dvec2(-0.001, 0.9), dvec2(1, 0.9), dvec2(0.9, -0.001), dvec2(0.9, 1),
                              dvec2(7, 0.9), dvec2(-7, -7)})
    EXPECT_EQ(cpu::sample(nearest, outside, 0).value, dvec4(0)) << outside.x << ", " << outside.y;
  for (const dvec2 inside : {dvec2(0.999, 0.999), dvec2(0.75, 0.75)})
    EXPECT_NEAR(cpu::sample(nearest, inside, 0).value.w * 255, 150, rounding);
  // All of a side's texel at its centre, half of it on the border, nothing half a texel outside.
  const MippedTexture linear{levels, false, sampler(Wrap::clamp_to_border, Filter::linear)};
  EXPECT_NEAR(code(linear, 0.875, 0.875), 150, rounding);
  EXPECT_NEAR(code(linear, 1, 0.875), 75, rounding);
  EXPECT_NEAR(code(linear, 1, 1), 37.5, rounding) << "a corner: three of four are the border";
  EXPECT_NEAR(code(linear, 1.0625, 0.875), 150 / 4.0, rounding);
  EXPECT_EQ(code(linear, 1.125, 0.875), 0);
  EXPECT_NEAR(code(linear, 0, 0.875), 120 / 2.0, rounding);
  EXPECT_EQ(code(linear, -0.125, 0.875), 0);
  EXPECT_NEAR(code(linear, 0.875, 0), 30 / 2.0, rounding);
}

TEST(CpuTexture, LinearMixesFourTexelsByTheirDistance) {
  const auto levels = ramp();
  const MippedTexture t{levels, false, sampler(Wrap::clamp_to_edge, Filter::linear)};
  EXPECT_NEAR(code(t, 0.375, 0.375), 50, rounding) << "a texel's centre";
  EXPECT_NEAR(code(t, 0.5, 0.375), 55, rounding);
  EXPECT_NEAR(code(t, 0.4375, 0.4375), 50 + 2.5 + 10, rounding);
  EXPECT_NEAR(code(t, 0.0, 0.0), 0, rounding);
  const MippedTexture r{levels, false, sampler(Wrap::repeat, Filter::linear)};
  EXPECT_NEAR(code(r, 0.0, 0.125), 15, rounding) << "halfway between the last and the first";
}

TEST(CpuTexture, DecodesBeforeItFilters) {
  Grid<u8vec4> image{2, 1};
  image(1, 0) = u8vec4(255);
  const std::vector<Grid<u8vec4>> levels{image};
  const MippedTexture t{levels, true, sampler(Wrap::clamp_to_edge, Filter::linear)};
  EXPECT_NEAR(cpu::sample(t, {0.5, 0.5}, 0).value.x, 0.5, rounding);
}

TEST(CpuTexture, DecodesSrgbByTheStandard) {
  EXPECT_EQ(cpu::linear_from_srgb_code(0), 0.0);
  EXPECT_EQ(cpu::linear_from_srgb_code(255), 1.0);
  EXPECT_NEAR(cpu::linear_from_srgb_code(10), 10 / 255.0 / 12.92, 1e-15);
  EXPECT_NEAR(cpu::linear_from_srgb_code(128), 0.21586050011389926, 1e-15);
}

/// Level k of 0..3 holds the code 40 k everywhere.
std::vector<Grid<u8vec4>> steps() {
  std::vector<Grid<u8vec4>> levels;
  for (int k = 0; k < 4; ++k)
    levels.emplace_back(8 >> k, 8 >> k, u8vec4(u8vec4::value_type(40 * k)));
  return levels;
}

TEST(CpuTexture, ChoosesOrMixesLevelsByTheMipMode) {
  const auto levels = steps();
  MippedTexture t{levels, false, {}};
  t.sampler.mip = Filter::linear;
  EXPECT_NEAR(code(t, 0.3, 0.3, -1), 0, rounding);
  EXPECT_NEAR(code(t, 0.3, 0.3, 0.25), 10, rounding);
  EXPECT_NEAR(code(t, 0.3, 0.3, 1.5), 60, rounding);
  EXPECT_NEAR(code(t, 0.3, 0.3, 9), 120, rounding);
  t.sampler.mip = Filter::nearest;
  EXPECT_NEAR(code(t, 0.3, 0.3, 0.5), 0, rounding) << "ceil(1) - 1";
  EXPECT_NEAR(code(t, 0.3, 0.3, 0.51), 40, rounding);
  EXPECT_NEAR(code(t, 0.3, 0.3, 2.5), 80, rounding);
  EXPECT_NEAR(code(t, 0.3, 0.3, 1e30), 120, rounding);
  t.sampler.mip.reset();
  EXPECT_NEAR(code(t, 0.3, 0.3, 2.5), 0, rounding);
}

TEST(CpuTexture, MeasuresTheFootprintInTexels) {
  EXPECT_NEAR(cpu::level_of_detail({0.25, 0}, {0, 0.125}, 16, 16), 2, 1e-15);
  EXPECT_NEAR(cpu::level_of_detail({0.03, 0.04}, {0, 0}, 100, 100), std::log2(5.0), 1e-14);
  EXPECT_LT(cpu::level_of_detail({0, 0}, {0, 0}, 16, 16), 0);
}

TEST(CpuTexture, SurvivesCoordinatesThatAreNotFinite) {
  const auto levels = cpu::mip_pyramid(ramp()[0], false);
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Filter filter : {Filter::nearest, Filter::linear})
    for (const double bad : {infinity, -infinity, std::nan(""), 1e300, -1e300}) {
      const MippedTexture t{levels, false, sampler(Wrap::mirrored_repeat, filter)};
      EXPECT_TRUE(std::isfinite(cpu::sample(t, {bad, bad}, 0).value.x)) << bad;
      EXPECT_TRUE(std::isfinite(cpu::sample({levels, false, {}}, {bad, bad}, bad).value.x));
    }
  EXPECT_FALSE(std::isnan(cpu::level_of_detail({std::nan(""), 0}, {0, 0}, 4, 4)));
}

/// The device's level of detail, as a texture of levels tells it. 8-bit codes of 16 a level.
double device_level(dvec2 dx, dvec2 dy, int width, int height) {
  std::vector<Grid<u8vec4>> levels;
  for (int k = 0; std::max(width, height) >> k > 0; ++k)
    levels.emplace_back(std::max(1, width >> k), std::max(1, height >> k),
                        u8vec4(u8vec4::value_type(16 * k)));
  const TextureFootprint f[] = {{{0.3f, 0.3f}, vec2(dx), vec2(dy)}};
  return gpu::sample(test_context(), {levels, false, {}}, f, 0.5f)[0].x * 255.0 / 16;
}

TEST(TextureErrata, LevelOfDetailCountsTexelsInBothDirections) {
  EXPECT_TRUE(measures_texels_a_pixel(cpu::level_of_detail));
  EXPECT_TRUE(measures_texels_a_pixel(device_level));
  EXPECT_FALSE(measures_texels_a_pixel([](dvec2 dx, dvec2, int, int) {
    return std::log2(std::max(std::abs(dx.x), std::abs(dx.y)));  // notes 6.3
  }));
  EXPECT_FALSE(measures_texels_a_pixel([](dvec2 dx, dvec2 dy, int width, int height) {
    const dvec2 x = glm::abs(dx * dvec2(width, height)), y = glm::abs(dy * dvec2(width, height));
    return std::log2(std::max({x.x, x.y, y.x, y.y}));  // with size and y, but not turned
  }));
}

TEST(TextureErrata, TexelsHaveTheirValueInTheirMiddle) {
  const auto row_of = [](const std::vector<double>& texels) {
    Grid<u8vec4> image{int(texels.size()), 1};
    for (std::size_t i = 0; i < texels.size(); ++i) image(int(i), 0).x = std::uint8_t(texels[i]);
    return image;
  };
  EXPECT_TRUE(reads_a_ramp_as_a_ramp([&](const std::vector<double>& texels, double u) {
    const std::vector<Grid<u8vec4>> levels{row_of(texels)};
    return 255 * cpu::sample({levels, false, {.wrap_u = Wrap::clamp_to_edge}}, {u, 0.5}, 0).value.x;
  }));
  EXPECT_FALSE(reads_a_ramp_as_a_ramp([](const std::vector<double>& texels, double u) {
    const double place = u * double(texels.size());  // notes 6.3: no half
    const auto i = std::min(std::size_t(place), texels.size() - 1);
    const double share = place - double(i);
    return (1 - share) * texels[i] + share * texels[std::min(i + 1, texels.size() - 1)];
  }));
}

TEST(TextureErrata, OddLevelsKeepTheMean) {
  EXPECT_TRUE(keeps_the_mean([](const std::vector<double>& row) {
    Grid<u8vec4> image{int(row.size()), 1};
    for (std::size_t i = 0; i < row.size(); ++i) image(int(i), 0).x = std::uint8_t(row[i]);
    std::vector<double> half;
    const std::vector<Grid<dvec4>> means = cpu::mip_means(image, false);
    for (const dvec4& mean : means[1]) half.push_back(mean.x);
    return half;
  }));
  EXPECT_FALSE(keeps_the_mean([](const std::vector<double>& row) {
    std::vector<double> half;
    for (std::size_t i = 0; i + 1 < row.size(); i += 2) half.push_back((row[i] + row[i + 1]) / 2);
    return half;
  }));
}

TEST(TextureErrata, TheLastPlaceHasATexel) {
  EXPECT_TRUE(finds_a_texel_everywhere([](double u, int size) {
    return *cpu::wrap_texel(std::int64_t(std::floor(u * size)), size, Wrap::clamp_to_edge);
  }));
  EXPECT_FALSE(finds_a_texel_everywhere(
      [](double u, int size) { return int(std::floor(u * size)); }));  // notes 6.3
}

TEST(SamplerAnswers, RejectAShiftedTexture) {
  Random random{5};
  const std::vector<Grid<u8vec4>> levels{texture_test::random_image(16, 16, random)};
  const MippedTexture t{levels, false, {.mip = {}}};
  const cpu::SamplerPrecision precision{.texel_weight = 0x1p-8};
  const dvec2 uv{0.31, 0.62};
  const auto answers = cpu::sample_answers(t, uv, {-1, -1}, precision);
  EXPECT_EQ(cpu::distance_to(answers, cpu::sample(t, uv, -1).value), 0);
  EXPECT_LT(cpu::distance_to(answers, cpu::sample(t, uv + 0.5 / 256 / 16, -1).value), 1e-12);
  EXPECT_GT(cpu::distance_to(answers, cpu::sample(t, uv + 0.5 / 16, -1).value), 0.01);
}

TEST(MipPyramid, KeepsTheMeanOfAnOddImage) {
  Grid<u8vec4> image{5, 3};
  for (int i = 0; i < 15; ++i)
    image.values()[std::size_t(i)] = u8vec4(i * 17, 255 - i * 17, i % 2 * 255, 255);
  double mean = 0;
  for (const u8vec4& t : image) mean += t.x / 15.0;
  const auto means = cpu::mip_means(image, false);
  ASSERT_EQ(means.size(), 3u);  // 5x3, 2x1, 1x1
  EXPECT_EQ(means[1].width(), 2);
  EXPECT_EQ(means[1].height(), 1);
  EXPECT_NEAR(means[2](0, 0).x, mean, 1e-12);
}

TEST(MipPyramid, AveragesInLinearLight) {
  Grid<u8vec4> image{2, 1};
  image(1, 0) = u8vec4(255);
  EXPECT_EQ(cpu::mip_pyramid(image, true)[1](0, 0).x, 188);  // sRGB code of linear 0.5
  EXPECT_EQ(cpu::mip_pyramid(image, false)[1](0, 0).x, 128);
  EXPECT_THROW(cpu::mip_pyramid({}, true), std::invalid_argument);
}

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

TEST(PerlinNoise, IsThePublishedFunction) {
  EXPECT_NEAR(cpu::procedural(Procedural::perlin, {3.14, 42, 7}), 0.13691995878400012, 1e-15);
  for (const dvec3 p : {dvec3(0, 0, 0), dvec3(-3, 200, 17), dvec3(5, -6, 300)})
    EXPECT_EQ(cpu::procedural(Procedural::perlin, p), 0);
}

/// At whole points every octave is 0, at halves all but the first are, at quarters all but two.
TEST(Fractals, EndWhereTheirOctavesMeetTheLattice) {
  for (const dvec3 whole : {dvec3(0), dvec3(-3, 200, 17), dvec3(5, -6, 1)}) {
    EXPECT_EQ(cpu::procedural(Procedural::fractal, whole), 0);
    EXPECT_EQ(cpu::procedural(Procedural::turbulence, whole), 0);
    EXPECT_NEAR(cpu::procedural(Procedural::marble, whole), 0.5, 1e-13);
    const auto noise = [](dvec3 p) { return cpu::procedural(Procedural::perlin, p); };
    for (const dvec3 part : {dvec3(0.5), dvec3(0.5, 0, 0.5), dvec3(0.25, 0.5, 0.75)}) {
      const dvec3 p = whole + part;
      EXPECT_NEAR(cpu::procedural(Procedural::fractal, p), noise(p) + noise(2.0 * p) / 2, 1e-15);
      EXPECT_NEAR(cpu::procedural(Procedural::turbulence, p),
                  std::abs(noise(p)) + std::abs(noise(2.0 * p)) / 2, 1e-15);
    }
  }
  EXPECT_NEAR(cpu::procedural(Procedural::wood, {0, 4, 1}), 0, 1e-13);
  EXPECT_NEAR(cpu::procedural(Procedural::wood, {3, 4, 0}), 0, 1e-13);
}

/// Octaves are as good as independent: their variances add up, 1 + 1/4 + 1/16 ..
TEST(Fractals, HaveTheVarianceOfTheirOctaves) {
  Random random{12};
  double noise = 0, fractal = 0;
  for (int i = 0; i < 20000; ++i) {
    const dvec3 p{random.uniform(0, 256), random.uniform(0, 256), random.uniform(0, 256)};
    noise += std::pow(cpu::procedural(Procedural::perlin, p), 2);
    const double sum = cpu::procedural(Procedural::fractal, p);
    fractal += sum * sum;
    EXPECT_GE(cpu::procedural(Procedural::turbulence, p), std::abs(sum));
  }
  const double want = (1 - std::pow(0.25, procedural_octaves)) / (1 - 0.25);
  // A ratio of two sums of 20000 squares of about normal numbers: 5 times sqrt(2 / 20000 2).
  EXPECT_NEAR(fractal / noise, want, 5 * std::sqrt(4.0 / 20000) * want);
}

TEST(Projection, PlanarAndCylindricalHaveTheirClosedForms) {
  const auto uv = [](Projection kind, dvec3 p) { return cpu::project(kind, p).uv; };
  const auto expect = [&](Projection kind, dvec3 p, dvec2 want) {
    EXPECT_LT(glm::distance(uv(kind, p), want), 1e-15) << p.x << " " << p.y << " " << p.z;
  };
  // The square from -1 to 1, v down; depth does not count.
  expect(Projection::planar, {-1, 1, 5}, {0, 0});
  expect(Projection::planar, {1, -1, -3}, {1, 1});
  expect(Projection::planar, {0.5, 0.25, 0}, {0.75, 0.375});
  // Around the y axis from +z over -x, -z (the middle) and +x; the distance does not count.
  expect(Projection::cylindrical, {0, 0, -1}, {0.5, 0.5});
  expect(Projection::cylindrical, {3, 1, 0}, {0.75, 0});
  expect(Projection::cylindrical, {-0.2, -1, 0}, {0.25, 1});
  expect(Projection::cylindrical, {2, 0.5, -2}, {0.625, 0.25});
  expect(Projection::cylindrical, {2, 0.5, 2}, {0.875, 0.25});
  expect(Projection::cylindrical, {-2, 0.5, 2}, {0.125, 0.25});
}

TEST(Projection, RoundTripsDirections) {
  Random random{2};
  for (int i = 0; i < 200; ++i) {
    const dvec3 d = glm::normalize(dvec3(random.direction()));
    for (const Projection kind : {Projection::spherical, Projection::cubic}) {
      const cpu::TexturePoint place = cpu::project(kind, d * 3.0);
      EXPECT_LT(glm::distance(cpu::direction_of(kind, place), d), 1e-14);
      EXPECT_TRUE(place.uv.x >= 0 && place.uv.x <= 1 && place.uv.y >= 0 && place.uv.y <= 1);
    }
  }
  EXPECT_LT(glm::distance(cpu::project(Projection::spherical, {0, 0, -1}).uv, dvec2(0.5)), 1e-15);
  EXPECT_EQ(cpu::project(Projection::cubic, {0, 1, 0}).face, 2);
  EXPECT_LT(glm::distance(cpu::triplanar_weights({0, 2, 0}), dvec3(0, 1, 0)), 1e-15);
}

TEST(Environment, HasNoSeams) {
  Random random{4};
  Grid<vec4> faces{8, 48}, picture{16, 8};
  for (vec4& t : faces) t = vec4(random.uniform());
  for (vec4& t : picture) t = vec4(random.uniform());
  const double step = 1e-9;  // of a slope of up to 16 texels a unit
  for (int i = 0; i < 400; ++i) {
    dvec3 d = glm::normalize(dvec3(random.direction()));
    if (i % 2 == 0) d.x = -d.z;  // on a cube's edge
    if (i % 2 == 1) d.x = 0;     // on the meridian where the picture's sides meet, or over a pole
    if (i % 4 == 3) d = {0, d.y > 0 ? 1 : -1, 0};
    const dvec3 aside{step, 0, step / 2};
    const auto across = [&](const auto& of, const auto& texels) {
      return std::abs(of(texels, d + aside).x - of(texels, d - aside).x);
    };
    EXPECT_LT(across(cpu::sample_cube_map, faces), 100 * step) << i;
    EXPECT_LT(across(cpu::sample_equirectangular, picture), 1e4 * step) << i;
  }
}

TEST(SurfaceDetail, FlatMapsChangeNothingAndSlopesTilt) {
  SurfaceDetail d{};
  d.normal = {0, 0, 2};
  d.tangent = {3, 0, 0, -1};
  d.p_u = {2, 0, 0};
  d.p_v = {1, 1, 0};
  d.texel = {0.5f, 0.5f, 1};
  d.scale = 1;
  EXPECT_LT(glm::distance(cpu::bump(d), dvec3(0, 0, 1)), 1e-15);
  EXPECT_LT(glm::distance(cpu::normal_map(d), dvec3(0, 0, 1)), 1e-15);
  d.slope = {2, 1};  // h = x
  EXPECT_LT(glm::distance(cpu::bump(d), glm::normalize(dvec3(-1, 0, 1))), 1e-15);
  d.texel = {0.5f, 1, 0.5f};  // along the bitangent, which the handedness turns
  EXPECT_LT(glm::distance(cpu::normal_map(d), dvec3(0, -1, 0)), 1e-15);
}

TEST(Parallax, MeetsAFlatFieldWhereGeometrySays) {
  const Grid<u8vec4> field{4, 4, u8vec4(51)};  // depth 0.8
  const cpu::ParallaxHit hit = cpu::parallax(field, {0.3, 0.4}, {0.6, 0, 0.8}, 0.1, 16);
  const double step = 1 / 16.0 / 256;
  EXPECT_NEAR(hit.depth, 0.8, step);
  EXPECT_NEAR(hit.uv.x, 0.3 - 0.8 * 0.1 * 0.75, 0.075 * step);
  EXPECT_EQ(cpu::parallax(field, {0.3, 0.4}, {0, 0, 1}, 0.1, 16).uv.x, 0.3);
}

/// A ramp: depth 1 - (256 u - 1/2) / 255. The ray's depth t is the field's at u + way t.
TEST(Parallax, MeetsARampWhereGeometrySays) {
  Grid<u8vec4> ramp{256, 2};
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 256; ++x) ramp(x, y) = u8vec4(x);
  for (const double lean : {-0.75, -0.2, 0.4, 0.75})
    for (const double u : {0.35, 0.5, 0.65}) {
      const double scale = 0.2, way = -scale * lean;
      const double depth = (1 - (256 * u - 0.5) / 255) / (1 + 256 * way / 255);
      for (const int layers : {16, 100}) {
        const cpu::ParallaxHit hit = cpu::parallax(ramp, {u, 0.3}, {lean, 0, 1}, scale, layers);
        EXPECT_NEAR(hit.depth, depth, 1 / 256.0 / layers) << lean << " " << u;
        EXPECT_NEAR(hit.uv.x, u + way * depth, std::abs(way) / 256 / layers);
        EXPECT_EQ(hit.uv.y, 0.3);
      }
    }
}

/// Half of a cylinder's top, of radius 1 around u = 1/2: heights (sqrt(1 - x^2) - low) / (1 - low),
/// low = sqrt(3) / 2 at the sides, x = u - 1/2.
TEST(Parallax, MeetsACylinderWhereGeometrySays) {
  const double low = std::sqrt(0.75), high = 1 - low;
  Grid<u8vec4> field{256, 2};
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 256; ++x) {
      const double c = (x + 0.5) / 256 - 0.5;
      field(x, y) = u8vec4(std::uint8_t(std::lround(255 * (std::sqrt(1 - c * c) - low) / high)));
    }
  for (const double way : {-0.1, -0.03, 0.05, 0.1})
    for (const double u : {0.3, 0.45, 0.5, 0.62}) {
      // (1 - t) high + low = sqrt(1 - (x + way t)^2), squared.
      const double x = u - 0.5, a = high * high + way * way, b = x * way - high, c = x * x;
      const double depth = (-b - std::sqrt(b * b - a * c)) / a;
      const cpu::ParallaxHit hit = cpu::parallax(field, {u, 0.3}, {-way, 0, 0.1}, 0.1, 64);
      // The field is off by half a code and by a chord's sag, 11.5 / 8 / 256^2; the ray meets it
      // where its depth and that of the field, of slope below 4.4 way, change places.
      const double error = 0.5 / 255 + 2.2e-5;
      EXPECT_NEAR(hit.depth, depth, error / (1 - 4.4 * std::abs(way)) + 1 / 256.0 / 64)
          << way << " " << u;
    }
}

/// A square of 3x3 squares in x and z, displaced along y; seen so that factors differ.
DisplacementProblem rough_square() {
  Random random{8};
  DisplacementProblem p;
  p.heights = texture_test::random_image(8, 8, random);
  p.scale = 0.3f;
  p.size = {400, 400};
  p.max_pixels = 8;
  const auto corner = [](int x, int y) {
    const vec2 uv = vec2(x, y) / 3.0f;
    return DisplacementCorner{{uv.x, 0, uv.y}, {0, 1, 0}, uv};
  };
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 3; ++x)
      for (const ivec2 c :
           {ivec2(0, 0), ivec2(1, 0), ivec2(1, 1), ivec2(0, 0), ivec2(1, 1), ivec2(0, 1)})
        p.corners.push_back(corner(x + c.x, y + c.y));
  p.clip_from_world = mat4(0.0f);  // x and y over 0.2 + 2 z
  p.clip_from_world[0][0] = p.clip_from_world[1][1] = 1;
  p.clip_from_world[2][3] = 2;
  p.clip_from_world[3][3] = 0.2f;
  return p;
}

TEST(Displacement, LeavesNoCracks) {
  const DisplacedMesh mesh = gpu::displace(test_context(), rough_square());
  std::set<std::uint32_t> factors;
  for (const uvec4& f : mesh.factors) factors.insert({f.x, f.y, f.z});
  EXPECT_GT(factors.size(), 2u) << "the test needs edges that differ";
  using Key = std::array<float, 6>;
  std::multiset<Key> edges;
  const auto key = [](const vec3& a, const vec3& b) { return Key{a.x, a.y, a.z, b.x, b.y, b.z}; };
  for (std::size_t i = 0; i < mesh.corners.size(); i += 3)
    for (std::size_t k = 0; k < 3; ++k) {
      const vec3 a = mesh.corners[i + k], b = mesh.corners[i + (k + 1) % 3];
      if (a != b) edges.insert(key(a, b));
    }
  for (const Key& e : edges) {
    const bool on_border =
        (e[0] == e[3] && (e[0] == 0 || e[0] == 1)) || (e[2] == e[5] && (e[2] == 0 || e[2] == 1));
    if (on_border) continue;
    EXPECT_EQ(edges.count(e), edges.count(Key{e[3], e[4], e[5], e[0], e[1], e[2]}))
        << e[0] << " " << e[2] << " to " << e[3] << " " << e[5];
  }
}

}  // namespace
}  // namespace parity
