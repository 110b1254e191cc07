#include "geometry/sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <eigen3/unsupported/Eigen/FFT>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "cpu_reference/sampling/area_coverage.h"
#include "cpu_reference/sampling/pattern.h"
#include "cpu_reference/sampling/reconstruct.h"
#include "cpu_reference/sampling/spectrum.h"
#include "cpu_reference/sampling/temporal.h"
#include "geometry/color.h"
#include "geometry/image_io.h"
#include "geometry/random.h"
#include "gpu/raster/renderer.h"
#include "gpu/sampling/area_coverage.h"
#include "gpu/sampling/reconstruct.h"
#include "gpu/sampling/spectrum.h"
#include "gpu/sampling/temporal.h"
#include "tests/gltf_builder.h"
#include "tests/gpu_context.h"
#include "tests/temporary_folder.h"

namespace parity {
namespace {

constexpr double pi = std::numbers::pi;

Grid<dvec2> random_signal(int width, int height, std::uint64_t seed) {
  Random random{seed};
  Grid<dvec2> signal{width, height};
  for (dvec2& v : signal) v = {random.uniform(-1, 1), random.uniform(-1, 1)};
  return signal;
}

double norm(const Grid<dvec2>& values) {
  double sum = 0;
  for (const dvec2& v : values) sum += glm::dot(v, v);
  return std::sqrt(sum);
}

TEST(Spectrum, OfAnImpulseIsAWaveOfOneLength) {
  Grid<dvec2> impulse{12, 7};
  impulse(3, 2) = {1, 0};
  const Grid<dvec2> spectrum = cpu::fourier_transform(impulse, false);
  for (int v = 0; v < 7; ++v)
    for (int u = 0; u < 12; ++u) {
      const double angle = -2 * pi * (3.0 * u / 12 + 2.0 * v / 7);
      EXPECT_NEAR(spectrum(u, v).x, std::cos(angle), 1e-13);
      EXPECT_NEAR(spectrum(u, v).y, std::sin(angle), 1e-13);
    }
}

TEST(Spectrum, KeepsTheEnergyAndComesBack) {
  for (const ivec2 size : {ivec2(1, 1), ivec2(2, 1), ivec2(64, 3), ivec2(131, 5), ivec2(30, 77)}) {
    const Grid<dvec2> signal = random_signal(size.x, size.y, 3);
    const Grid<dvec2> spectrum = cpu::fourier_transform(signal, false);
    EXPECT_NEAR(norm(spectrum), norm(signal) * std::sqrt(double(signal.size())),
                1e-13 * norm(spectrum));
    const Grid<dvec2> back = cpu::fourier_transform(spectrum, true);
    for (std::size_t i = 0; i < signal.size(); ++i)
      EXPECT_NEAR(glm::distance(back.values()[i], signal.values()[i]), 0, 1e-13);
  }
}

TEST(Spectrum, OfALineIsWhatEigenSays) {
  for (const int count : {2, 60, 64, 131, 210}) {
    const Grid<dvec2> signal = random_signal(count, 1, std::uint64_t(count));
    std::vector<std::complex<double>> in, out;
    Grid<vec2> single{count, 1};
    for (int i = 0; i < count; ++i) {
      single(i, 0) = vec2(signal(i, 0));
      in.emplace_back(signal(i, 0).x, signal(i, 0).y);
    }
    Eigen::FFT<double> third;
    third.fwd(out, in);
    const Grid<dvec2> host = cpu::fourier_transform(signal, false);
    const Grid<vec2> device = gpu::fourier_transform(test_context(), single, false);
    double apart = 0;
    for (int i = 0; i < count; ++i) {
      const dvec2 want{out[std::size_t(i)].real(), out[std::size_t(i)].imag()};
      EXPECT_LT(glm::distance(host(i, 0), want), 1e-12 * norm(host));
      apart = std::hypot(apart, glm::distance(dvec2(device(i, 0)), want));
    }
    EXPECT_LE(apart, (gpu::fourier_error_bound(count, 1) + 0x1p-24) * norm(host)) << count;
  }
}

TEST(Spectrum, RefusesWhatItCannotTransform) {
  EXPECT_THROW(cpu::fourier_transform({}, false), std::invalid_argument);
  EXPECT_THROW(gpu::fourier_transform(test_context(), {}, false), std::invalid_argument);
}

cpu::SpectrumPeak measured_peak(double f) {
  const auto peaks =
      cpu::spectrum_peaks(cpu::fourier_transform(cpu::windowed(grating(256, 1, {f, 0})), false), 1);
  return peaks.empty() ? cpu::SpectrumPeak{} : peaks[0];
}
double measured_frequency(double f) { return measured_peak(f).frequency.x; }

/// Does a rule that says whether frequency f, sampled at 1, aliases, say what samples show? Those
/// nearer to 0 or half the rate than 4 bins cannot be told.
bool tells_aliasing(const std::function<bool(double)>& rule) {
  for (int i = 1; i < 60; ++i) {
    const double f = i * 0.037;
    if (cpu::alias_frequency(f, 1) < 4.0 / 256 || cpu::alias_frequency(f, 1) > 0.5 - 4.0 / 256)
      continue;
    if (rule(f) != (std::abs(measured_frequency(f) - f) > 1e-3)) return false;
  }
  return true;
}

TEST(Aliasing, SetsInBelowTwiceTheFrequencyNotBelowIt) {
  EXPECT_TRUE(tells_aliasing([](double f) { return 1 < 2 * f; }));
  EXPECT_FALSE(tells_aliasing([](double f) { return 1 < f; }));  // notes 1.8, read literally
}

TEST(Aliasing, ACosineComesBackAtTheDistanceToAMultipleOfTheRate) {
  for (int i = 1; i < 80; ++i) {
    const double f = i * 0.0371;
    double nearest = f;
    for (int k = 0; k < 5; ++k) nearest = std::min(nearest, std::abs(f - k));
    EXPECT_NEAR(cpu::alias_frequency(f, 1), nearest, 1e-12);
    // The other, negative frequency is as far as twice this: within 4 bins it moves the peak.
    if (nearest < 4.0 / 256 || nearest > 0.5 - 4.0 / 256) continue;
    EXPECT_NEAR(measured_frequency(f), nearest, 0.02 / 256) << f;
    // A Gaussian's logarithm is a parabola; the window's is cut at exp(-8), three bins add up.
    EXPECT_NEAR(measured_peak(f).amplitude, 0.5, 0.5 * 3 * std::exp(-8.0)) << f;
  }
  EXPECT_EQ(cpu::windowed(grating(256, 1, {3, 0})), Grid<dvec2>(256, 1));  // constant: nothing left
}

TEST(Aliasing, AZonePlateShowsRingsThatItDoesNotHave) {
  constexpr int side = 1024, patch = 64;
  const Grid<double> plate = zone_plate(side, patch, 4);
  for (int left = side / 2; left + patch <= side; left += 32) {
    Grid<double> part{patch, 1};
    for (int x = 0; x < patch; ++x) part(x, 0) = plate(left + x, patch / 2);
    const double f = 4.0 * (left + patch / 2 - side / 2) / side;
    const double alias = cpu::alias_frequency(f, 1);
    if (alias < 4.0 / patch || alias > 0.5 - 4.0 / patch) continue;
    const auto peaks = cpu::spectrum_peaks(cpu::fourier_transform(cpu::windowed(part), false), 1);
    EXPECT_NEAR(peaks.at(0).frequency.x, alias, 0.1 / patch) << f;
  }
}

TEST(Aliasing, AWheelSeemsToTurnTheNearestWay) {
  EXPECT_NEAR(cpu::apparent_turn(0.1, 8, 1), 0.1, 1e-15);
  EXPECT_NEAR(cpu::apparent_turn(2 * pi / 8, 8, 1), 0, 1e-15);
  EXPECT_NEAR(cpu::apparent_turn(2 * pi / 8 - 0.1, 8, 1), -0.1, 1e-15);
  EXPECT_NEAR(cpu::apparent_turn(24 * 2 * pi / 5 + 1, 5, 1.0 / 24), 1, 1e-12);
}

/// Twice the sum of a filter times a cosine, by the middle rule.
double integrated_spectrum(ReconstructionFilter filter, double f) {
  constexpr int steps = 20000;
  const double reach = filter_radius(filter), h = reach / steps;
  double sum = 0;
  for (int i = 0; i < steps; ++i)
    sum += cpu::filter_value(filter, (i + 0.5) * h) * std::cos(2 * pi * f * (i + 0.5) * h);
  return 2 * sum * h;
}

TEST(Filters, HaveTheSpectraOfTheirClosedForms) {
  for (const ReconstructionFilter filter : all_reconstruction_filters)
    for (const double f : {0.0, 0.004, 0.1, 0.25, 0.5, 0.77, 1.0, 1.5, 2.9}) {
      // The middle rule: h^2 / 24 times the change of slope, (2 pi f)^2 reach at most; the
      // Gaussian's closed form leaves out what is cut off.
      const double cut = filter == ReconstructionFilter::gaussian ? 6.4e-5 : 0;
      EXPECT_NEAR(cpu::filter_spectrum(filter, f), integrated_spectrum(filter, f), cut + 2e-6)
          << name_of(filter) << " " << f;
    }
}

TEST(Filters, KeepAConstant) {
  Grid<dvec4> grey{5, 3, dvec4(0.25, 0.5, 0.75, 1)};
  Grid<vec4> single{5, 3, vec4(0.25, 0.5, 0.75, 1)};
  for (const ReconstructionFilter filter : all_reconstruction_filters)
    for (const ivec2 size : {ivec2(1, 1), ivec2(5, 3), ivec2(11, 2), ivec2(40, 17)}) {
      for (const dvec4& v : cpu::reconstruct(grey, size, filter))
        EXPECT_NEAR(glm::distance(v, grey(0, 0)), 0, 1e-14);
      for (const vec4& v : gpu::reconstruct(test_context(), single, size, filter))
        EXPECT_NEAR(glm::distance(v, single(0, 0)), 0, 1e-5f);
    }
}

TEST(Filters, ABoxOfWholePixelsIsTheMean) {
  Grid<dvec4> picture{6, 4};
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 6; ++x) picture(x, y) = dvec4(x + 10 * y);
  const Grid<dvec4> half = cpu::reconstruct(picture, {3, 2}, ReconstructionFilter::box);
  EXPECT_NEAR(half(0, 0).x, 5.5, 1e-13);
  EXPECT_NEAR(half(2, 1).x, 29.5, 1e-13);
}

TEST(Filters, ATentGoesStraightBetweenTexels) {
  Grid<dvec4> picture{8, 1};
  for (int x = 0; x < 8; ++x) picture(x, 0) = dvec4(x + 0.5);
  const Grid<dvec4> fine = cpu::reconstruct(picture, {40, 1}, ReconstructionFilter::tent);
  for (int x = 3; x < 37; ++x) EXPECT_NEAR(fine(x, 0).x, (x + 0.5) / 5, 1e-13);
}

/// Does a magnified step leave [0, 1]?
bool rings(ReconstructionFilter filter) {
  Grid<dvec4> step{16, 1};
  for (int x = 8; x < 16; ++x) step(x, 0) = dvec4(1);
  for (const dvec4& v : cpu::reconstruct(step, {160, 1}, filter))
    if (v.x < -1e-3 || v.x > 1 + 1e-3) return true;
  return false;
}

bool tells_ringing(const std::function<bool(ReconstructionFilter)>& rule) {
  for (const ReconstructionFilter filter : all_reconstruction_filters)
    if (rule(filter) != rings(filter)) return false;
  return true;
}

TEST(Filters, RingOnlyWithNegativeLobes) {
  using enum ReconstructionFilter;
  EXPECT_TRUE(tells_ringing([](auto f) { return f == mitchell || f == lanczos; }));
  // Notes 1.8, read literally: box, linear and Gaussian trade blur against ringing.
  EXPECT_FALSE(tells_ringing([](auto f) { return f == box || f == tent || f == gaussian; }));
}

/// A white square without light, from pixel 1.5 to pixel 6.5 of a picture of 8.
std::vector<std::byte> half_covered_pixels() {
  GltfBuilder gltf;
  gltf.root["materials"] = {{{"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 1}}}},
                             {"extensions", {{"KHR_materials_unlit", nlohmann::json::object()}}}}};
  gltf.root["extensionsUsed"] = {"KHR_materials_unlit"};
  gltf.root["cameras"] = {
      {{"type", "orthographic"},
       {"orthographic", {{"xmag", 1}, {"ymag", 1}, {"znear", 0.5}, {"zfar", 2.5}}}}};
  const float a = 0.625f;
  const int places = gltf.accessor<float>({-a, -a, 0, a, -a, 0, a, a, 0, -a, a, 0}, "VEC3",
                                          {{"min", {-a, -a, 0}}, {"max", {a, a, 0}}});
  const int indices = gltf.accessor<std::uint32_t>({0, 1, 2, 0, 2, 3}, "SCALAR");
  gltf.show({{"attributes", {{"POSITION", places}}}, {"indices", indices}, {"material", 0}});
  gltf.root["nodes"].push_back({{"camera", 0}, {"translation", {0, 0, 1}}});
  gltf.root["scenes"][0]["nodes"] = {0, 1};
  return gltf.glb();
}

/// Half of a pixel white, half black: half the light, sRGB code 188; the mean of the codes is 128.
/// A corner has a quarter: 137, not 64.
TEST(WholePath, ResolvesInLinearLightAndEncodesAfterwards) {
  EXPECT_NEAR(255 * srgb_from_linear(0.5), 188, 0.5);
  EXPECT_NEAR(255 * srgb_from_linear(0.25), 137, 0.5);
  const TemporaryFolder folder;
  folder.write("square.glb", half_covered_pixels());
  std::vector<std::string> modes{"--msaa 4 --backend cpu"};
  if (gpu::can_render(test_context().info()))
    for (const char* mode : {"--msaa 4", "--aa ssaa4", "--aa accumulate4"}) modes.push_back(mode);
  for (const std::string& mode : modes) {
    const std::string command = "cd '" + folder.path().string() +
                                "' && '" PARITY_PROGRAM
                                "' render square.glb -o square.png --size 8x8 -q --tone-map none "
                                "--background '#000000' " +
                                mode;
    ASSERT_EQ(std::system(command.c_str()), 0) << command;
    const Grid<vec4> picture = load_image(folder.path() / "square.png");  // decoded
    const auto code = [&](int x, int y) {
      return std::lround(255 * srgb_from_linear(double(picture(x, y).x)));
    };
    EXPECT_EQ(code(0, 4), 0) << mode;
    EXPECT_EQ(code(4, 4), 255) << mode;
    for (const ivec2 side : {ivec2(1, 4), ivec2(6, 4), ivec2(4, 1), ivec2(4, 6)})
      EXPECT_EQ(code(side.x, side.y), 188) << mode << ", " << side.x << " " << side.y;
    for (const ivec2 corner : {ivec2(1, 1), ivec2(6, 1), ivec2(1, 6), ivec2(6, 6)})
      EXPECT_EQ(code(corner.x, corner.y), 137) << mode << ", " << corner.x << " " << corner.y;
  }
}

TEST(Filters, RefuseSizesThatDoNotExist) {
  const Grid<vec4> picture{2, 2};
  EXPECT_THROW(gpu::reconstruct(test_context(), picture, {0, 1}, ReconstructionFilter::box),
               std::invalid_argument);
  EXPECT_THROW(gpu::reconstruct(test_context(), {}, {1, 1}, ReconstructionFilter::box),
               std::invalid_argument);
  EXPECT_THROW(cpu::reconstruct({}, {1, 1}, ReconstructionFilter::box), std::invalid_argument);
}

TEST(Filters, TheAreaBesideALineIsExact) {
  EXPECT_DOUBLE_EQ(half_plane_area({1, 0}, 0.3), 0.3);
  EXPECT_DOUBLE_EQ(half_plane_area({0, -1}, -0.3), 0.7);
  EXPECT_DOUBLE_EQ(half_plane_area({1, 1}, 0.5), 0.125);
  EXPECT_DOUBLE_EQ(half_plane_area({1, 1}, 1.5), 0.875);
  EXPECT_DOUBLE_EQ(half_plane_area({1, 2}, 5), 1);
  EXPECT_DOUBLE_EQ(half_plane_area({1, 2}, -1), 0);
}

TEST(Patterns, StratifiedOnesHaveOneSampleInEachCellAndRow) {
  for (const SamplePattern pattern : {SamplePattern::jittered, SamplePattern::multi_jittered}) {
    std::vector<int> cells(16), columns(16), rows(16);
    for (const dvec2& p : cpu::pattern(pattern, 16, 3)) {
      ++cells[std::size_t(4 * int(4 * p.y) + int(4 * p.x))];
      ++columns[std::size_t(16 * p.x)];
      ++rows[std::size_t(16 * p.y)];
    }
    for (const int count : cells) EXPECT_EQ(count, 1);
    if (pattern == SamplePattern::jittered) continue;
    for (int i = 0; i < 16; ++i) EXPECT_EQ(columns[std::size_t(i)] * rows[std::size_t(i)], 1);
  }
}

TEST(Patterns, SobolPutsASampleInEachIntervalOfArea16) {
  const std::vector<dvec2> samples = cpu::pattern(SamplePattern::sobol, 16, 5);
  for (int width = 1; width <= 16; width *= 2) {
    std::vector<int> counts(16);
    for (const dvec2& p : samples)
      ++counts[std::size_t(int(p.x * width) * (16 / width) + int(p.y * (16 / width)))];
    for (const int count : counts) EXPECT_EQ(count, 1) << width;
  }
}

TEST(Patterns, BlueNoiseKeepsItsDistance) {
  const auto least = [](const std::vector<dvec2>& samples) {
    double nearest = 1;
    for (std::size_t i = 0; i < samples.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const dvec2 apart = samples[i] - samples[j];
        nearest =
            std::min(nearest, std::hypot(std::remainder(apart.x, 1), std::remainder(apart.y, 1)));
      }
    return nearest;
  };
  // The densest packing has sqrt(2 / sqrt(3) / n); best candidates reach more than half of it.
  EXPECT_GT(least(cpu::pattern(SamplePattern::blue_noise, 256, 1)),
            0.5 * std::sqrt(2 / std::sqrt(3.0) / 256));
  EXPECT_LT(least(cpu::pattern(SamplePattern::random, 256, 1)), 0.02);
}

/// Row 21: the mean of jittered estimates is the truth, their variance at most that of chance, 1/N.
TEST(Patterns, JitterIsRightOnAverageAndVariesLessThanChance) {
  const dvec2 normal{0.6, 0.8};
  const double area = half_plane_area(normal, 0.55);
  for (const SamplePattern pattern : {SamplePattern::random, SamplePattern::jittered}) {
    constexpr int seeds = 400, samples = 16;
    double sum = 0, squares = 0;
    for (int seed = 1; seed <= seeds; ++seed) {
      double inside = 0;
      for (const dvec2& p : cpu::pattern(pattern, samples, std::uint32_t(seed)))
        inside += glm::dot(normal, p) < 0.55;
      sum += inside / samples;
      squares += std::pow(inside / samples - area, 2);
    }
    const double chance = area * (1 - area) / samples;
    EXPECT_NEAR(sum / seeds, area, 4 * std::sqrt(chance / seeds));
    // The variance of 400 squares: relative deviation sqrt(2 / 400), four of them.
    EXPECT_LT(squares / seeds, chance * (pattern == SamplePattern::random ? 1.29 : 0.6));
  }
}

TEST(AreaCoverage, SumsToTheAreaOfThePolygonAndOfItsHole) {
  const Polygon square{{{{1.25f, 1.5f}, {6.75f, 1.5f}, {6.75f, 5}, {1.25f, 5}},
                        {{3, 2}, {3, 3.5f}, {4.5f, 3.5f}, {4.5f, 2}}}};
  const Grid<double> host = cpu::area_coverage(square, 8, 8);
  const Grid<float> device = gpu::area_coverage(test_context(), square, 8, 8);
  double sum = 0, device_sum = 0;
  for (const double area : host) sum += area;
  for (const float area : device) device_sum += double(area);
  EXPECT_NEAR(sum, 5.5 * 3.5 - 1.5 * 1.5, 1e-12);
  EXPECT_NEAR(device_sum, sum, 64 * gpu::area_coverage_bound(square, 8, 8));
  EXPECT_DOUBLE_EQ(host(1, 1), 0.75 * 0.5);
  EXPECT_DOUBLE_EQ(host(3, 2), 0);
}

TEST(AreaCoverage, IsTheAreaBesideALine) {
  // A large triangle whose one side crosses the pixel (2, 2) from corner to corner, and below.
  const Polygon triangle{{{{-40, 45}, {45, -40}, {45, 45}}}};
  const Grid<double> areas = cpu::area_coverage(triangle, 5, 5);
  EXPECT_NEAR(areas(2, 2), 1 - half_plane_area({1, 1}, 1), 1e-12);
  EXPECT_NEAR(areas(2, 3), 1, 1e-12);
  EXPECT_NEAR(areas(1, 2), 0, 1e-12);
}

TEST(Temporal, AccumulationOfAPictureAtRestIsItsMean) {
  Grid<vec4> history{1, 1};
  Random random{3};
  float sum = 0;
  for (int frame = 0; frame < 12; ++frame) {
    const float value = random.uniform();
    sum += value;
    const vec2 motion = frame == 0 ? vec2(9) : vec2(0);
    history = gpu::accumulate(test_context(), {Grid<vec4>(1, 1, vec4(value)), history,
                                               Grid<vec2>(1, 1, motion), 64, false});
  }
  EXPECT_NEAR(history(0, 0).x, sum / 12, 1e-6f);
  EXPECT_EQ(history(0, 0).w, 12);
}

TEST(Temporal, AHistoryThatDoesNotFitIsGivenUp) {
  const TemporalStep step{Grid<vec4>(3, 3, vec4(0)), Grid<vec4>(3, 3, vec4(1, 1, 1, 20)),
                          Grid<vec2>(3, 3, vec2(0))};
  EXPECT_EQ(cpu::accumulate(step)(1, 1), dvec4(0, 0, 0, 1));
  EXPECT_EQ(gpu::accumulate(test_context(), step)(1, 1), vec4(0, 0, 0, 1));
}

}  // namespace
}  // namespace parity
