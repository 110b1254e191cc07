#include "cpu_reference/sampling/spectrum.h"

#include <fftw3.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "geometry/random.h"
#include "geometry/sampling.h"
#include "gpu/sampling/spectrum.h"
#include "tests/chart.h"
#include "tests/stage.h"

namespace parity {
namespace {

struct SpectrumProblem {
  Grid<vec2> values;
  bool inverse = false;
};
auto fields_of(const SpectrumProblem*) {
  return std::tuple{&SpectrumProblem::values, &SpectrumProblem::inverse};
}

SpectrumProblem random_signal(const Setting& setting) {
  SpectrumProblem p;
  p.values = {setting.count("width"), setting.count("height")};
  Random random{setting.seed};
  for (vec2& v : p.values) v = {random.uniform(-1, 1), random.uniform(-1, 1)};
  p.inverse = setting.count("inverse") != 0;
  return p;
}

Grid<dvec2> in_double(const Grid<vec2>& values) {
  Grid<dvec2> result{values.width(), values.height()};
  for (std::size_t i = 0; i < values.size(); ++i) result.values()[i] = dvec2(values.values()[i]);
  return result;
}

/// A third opinion. FFTW's inverse is not divided by the number of pixels.
Grid<dvec2> by_library(const SpectrumProblem& p) {
  Grid<dvec2> values = in_double(p.values);
  auto* data = reinterpret_cast<fftw_complex*>(values.values().data());
  const std::unique_ptr<fftw_plan_s, void (*)(fftw_plan)> plan{
      fftw_plan_dft_2d(values.height(), values.width(), data, data,
                       p.inverse ? FFTW_BACKWARD : FFTW_FORWARD, FFTW_ESTIMATE),
      fftw_destroy_plan};
  fftw_execute(plan.get());
  if (p.inverse)
    for (dvec2& value : values) value /= double(values.size());
  return values;
}

/// ||got - want|| / ||want||.
double relative_distance(const Grid<dvec2>& got, const Grid<dvec2>& want) {
  double apart = 0, size = 0;
  for (std::size_t i = 0; i < want.size(); ++i) {
    const dvec2 d = got.values()[i] - want.values()[i];
    apart += glm::dot(d, d);
    size += glm::dot(want.values()[i], want.values()[i]);
  }
  return size > 0 ? std::sqrt(apart / size) : std::sqrt(apart);
}

Axis side_axis(const char* name) {
  return {.name = name,
          .unit = "px",
          .low = 1,
          .high = 509,
          .standard = 120,
          .logarithmic = true,
          .whole = true};
}

const Registration registration = register_stage<SpectrumProblem, Grid<dvec2>>({
    .name = "sampling/spectrum",
    .title = "Fourier transform of a picture of any size",
    .source = "notes 1.8; Cooley & Tukey 1965; Stockham 1966",
    .rows = {16, 18},
    .axes = {side_axis("width"),
             side_axis("height"),
             {.name = "inverse", .low = 0, .high = 1, .whole = true, .each = true}},
    .problem = random_signal,
    .cpu = {{.solve =
                 [](const SpectrumProblem& p) {
                   return cpu::fourier_transform(in_double(p.values), p.inverse);
                 }},
            {.name = "definition",
             .solve =
                 [](const SpectrumProblem& p) {
                   if (p.values.width() + p.values.height() > 600)
                     throw Unsupported("the sum takes too long");
                   return cpu::fourier_sum(in_double(p.values), p.inverse);
                 },
             .must_agree = true},
            {.name = "FFTW", .solve = by_library, .must_agree = true}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const SpectrumProblem& p) {
                   return in_double(gpu::fourier_transform(context, p.values, p.inverse));
                 }}},
    .distance = relative_distance,
    .tolerance =
        [](const SpectrumProblem& p) {
          return gpu::fourier_error_bound(p.values.width(), p.values.height());
        },
    .why = "relative, in the 2-norm: a pass of radix r adds r products with rounded roots, "
           "(r + 6) 2^-24 of the sum of magnitudes, which is at most sqrt(r) of their norm; the "
           "passes add up",
    .chart_axes = {"width"},
});

/// The frequency that is found in samples of a cosine.
double measured_frequency(gpu::Context& context, double f, int count) {
  const Grid<dvec2> signal = cpu::windowed(grating(count, 1, {f, 0}));
  Grid<vec2> single{count, 1};
  for (int i = 0; i < count; ++i) single(i, 0) = vec2(signal(i, 0));
  const auto peaks =
      cpu::spectrum_peaks(in_double(gpu::fourier_transform(context, single, false)), 1);
  return peaks.empty() ? 0 : peaks[0].frequency.x;
}

ChartData alias_frequencies(gpu::Context& context) {
  Series measured{"measured, device", {}};
  Series theory{"|f - k fs|", {}, Series::Kind::theory};
  constexpr int count = 512;
  double worst = 0;
  for (int i = 1; i < 240; ++i) {
    const double f = 0.0123 * i;
    const double alias = cpu::alias_frequency(f, 1);
    theory.points.push_back({f, alias});
    if (alias < 4.0 / count || alias > 0.5 - 4.0 / count) continue;
    measured.points.push_back({f, measured_frequency(context, f, count)});
    worst = std::max(worst, std::abs(measured.points.back().y - alias) * count);
  }
  return {.series = {measured, theory},
          .assertions = {{"farthest from |f - k fs|, in bins of the transform", worst, 0.02}},
          .settings = {{"samples", std::to_string(count)},
                       {"window", "Gaussian, an eighth of the length"}}};
}

const Registration alias_chart = register_chart({
    .name = "sampling/alias_frequency",
    .title = "Frequency that a cosine has after sampling",
    .x = {.label = "frequency", .unit = "samples⁻¹", .logarithmic = false},
    .y = {.label = "frequency seen", .unit = "samples⁻¹", .logarithmic = false},
    .produce = alias_frequencies,
});

/// Along the radius of a zone plate that reaches twice the sampling rate at its border.
ChartData zone_plate_frequencies(gpu::Context& context) {
  constexpr int side = 2048, patch = 64;
  constexpr double k = 4;  // 2 cycles a pixel at the border
  const Grid<double> plate = zone_plate(side, patch, k);
  Series measured{"measured, device", {}};
  Series theory{"|f - k fs|", {}, Series::Kind::theory};
  double worst = 0;
  for (int left = side / 2; left + patch <= side; left += 16) {
    Grid<double> part{patch, 1};
    for (int x = 0; x < patch; ++x) part(x, 0) = plate(left + x, patch / 2);
    const double f = k * (left + patch / 2 - side / 2) / side;
    const double alias = cpu::alias_frequency(f, 1);
    theory.points.push_back({f, alias});
    if (alias < 4.0 / patch || alias > 0.5 - 4.0 / patch) continue;
    const Grid<dvec2> signal = cpu::windowed(part);
    Grid<vec2> single{patch, 1};
    for (int x = 0; x < patch; ++x) single(x, 0) = vec2(signal(x, 0));
    const auto peaks =
        cpu::spectrum_peaks(in_double(gpu::fourier_transform(context, single, false)), 1);
    measured.points.push_back({f, peaks.empty() ? 0 : peaks[0].frequency.x});
    worst = std::max(worst, std::abs(measured.points.back().y - alias) * patch);
  }
  return {
      .series = {measured, theory},
      .assertions = {{"farthest from |f - k fs|, in bins of a patch", worst, 0.1}},
      .settings = {{"zone plate", "2048 px, 2 cycles a pixel at the border"}, {"patch", "64 px"}}};
}

const Registration zone_chart = register_chart({
    .name = "sampling/zone_plate",
    .title = "Local frequency of a sampled zone plate along its radius",
    .x = {.label = "frequency of the plate", .unit = "px⁻¹", .logarithmic = false},
    .y = {.label = "frequency seen", .unit = "px⁻¹", .logarithmic = false},
    .produce = zone_plate_frequencies,
});

/// Two pixels of a wheel, a quarter of the way from spoke to spoke apart: as real and imaginary
/// part they are a wave that turns as the wheel does.
struct WheelPixels {
  ivec2 real{0};
  ivec2 imaginary{0};
};

WheelPixels quarter_apart(int side, int spokes) {
  const auto angle = [&](ivec2 p) {
    const dvec2 q = dvec2(p) + 0.5 - 0.5 * side;
    return std::atan2(-q.y, q.x);
  };
  WheelPixels pixels{{side - 3, side / 2}, {0, 0}};
  double best = 10;
  for (int y = 0; y < side; ++y)
    for (int x = 3 * side / 4; x < side - 2; ++x) {
      const double apart = spokes * (angle({x, y}) - angle(pixels.real)) - std::numbers::pi / 2;
      if (std::abs(apart) < best) best = std::abs(apart), pixels.imaginary = {x, y};
    }
  return pixels;
}

constexpr int wheel_frames = 256;

using Transform = std::function<Grid<dvec2>(const Grid<dvec2>&)>;

/// How fast a wheel seems to turn, radians a frame, from what two of its pixels show in 256 frames:
/// the strongest frequency of their transform, from half a cycle a frame backwards to half a cycle
/// forwards. Not a number if nothing moves.
double measured_turn(const Transform& transform, double turn, int spokes) {
  constexpr int side = 32;
  const WheelPixels pixels = quarter_apart(side, spokes);
  Grid<double> real{wheel_frames, 1}, imaginary{wheel_frames, 1};
  for (int frame = 0; frame < wheel_frames; ++frame) {
    const Grid<double> picture = wheel(side, spokes, 0.3 + turn * frame);
    real(frame, 0) = picture(pixels.real.x, pixels.real.y);
    imaginary(frame, 0) = picture(pixels.imaginary.x, pixels.imaginary.y);
  }
  const Grid<dvec2> re = cpu::windowed(real), im = cpu::windowed(imaginary);
  Grid<dvec2> wave{wheel_frames, 1};
  for (int i = 0; i < wheel_frames; ++i) wave(i, 0) = {re(i, 0).x, im(i, 0).x};
  const Grid<dvec2> spectrum = transform(wave);
  const auto size = [&](int bin) {
    return std::log(glm::length(spectrum((bin + wheel_frames) % wheel_frames, 0)));
  };
  int peak = 0;
  for (int bin = 1 - wheel_frames / 2; bin < wheel_frames / 2; ++bin)
    if (size(bin) > size(peak)) peak = bin;
  const double below = size(peak - 1), here = size(peak), above = size(peak + 1);
  const double place = peak + 0.5 * (below - above) / (below - 2 * here + above);
  return 2 * std::numbers::pi * place / wheel_frames / spokes;
}

/// A pixel's light is a square wave: its third and fifth harmonics meet the first at multiples of a
/// quarter of a cycle a frame, and at 0 nothing moves. Not within 5 bins of the transform of those.
bool can_be_told(double turn, int spokes) {
  const double quarters = 4 * spokes * turn / (2 * std::numbers::pi);
  return std::abs(quarters - std::round(quarters)) > 4 * 5.0 / wheel_frames;
}

/// In bins. Harmonics 7, 9, 15 and 17 meet the first at eighths of a cycle a frame, as strong as 1
/// over their number; each moves the peak of a Gaussian of 1.3 bins by at most 1.3 exp(-1/2) of it.
constexpr double wheel_tolerance = 0.79 * (1 / 7.0 + 1 / 9.0 + 1 / 15.0 + 1 / 17.0);

TEST(Aliasing, AFilmedWheelTurnsAsItsPixelsSay) {
  constexpr int spokes = 8;
  const Transform on_cpu = [](const Grid<dvec2>& v) { return cpu::fourier_transform(v, false); };
  const double wrap = 2 * std::numbers::pi / spokes;
  for (const double share : {0.1, 0.37, 0.6, 0.9, 1.15, 2.4, 2.62, -0.3}) {
    ASSERT_TRUE(can_be_told(share * wrap, spokes)) << share;
    EXPECT_NEAR(measured_turn(on_cpu, share * wrap, spokes),
                cpu::apparent_turn(share * wrap, spokes, 1), wheel_tolerance / wheel_frames * wrap)
        << share;
  }
}

ChartData wagon_wheel(gpu::Context& context) {
  constexpr int spokes = 8;
  constexpr double period = 1.0 / 24;
  Series measured{"measured in two pixels", {}};
  Series theory{"omega modulo 2 pi / (8 T)", {}, Series::Kind::theory};
  double worst = 0;
  const Transform on_device = [&](const Grid<dvec2>& values) {
    Grid<vec2> single{values.width(), values.height()};
    std::copy(values.begin(), values.end(), single.begin());
    return in_double(gpu::fourier_transform(context, single, false));
  };
  const double wrap = 2 * std::numbers::pi / spokes / period;
  for (int i = 0; i <= 120; ++i) {
    const double omega = i * 0.5;
    const double apparent = cpu::apparent_turn(omega, spokes, period);
    theory.points.push_back({omega, apparent});
    if (!can_be_told(omega * period, spokes)) continue;
    measured.points.push_back({omega, measured_turn(on_device, omega * period, spokes) / period});
    worst = std::max(worst, std::abs(measured.points.back().y - apparent));
  }
  return {.series = {measured, theory},
          .assertions = {{"farthest from omega modulo 2 pi / (8 T), in bins of the transform",
                          worst / wrap * wheel_frames, wheel_tolerance}},
          .settings = {{"spokes", "8"},
                       {"frames", "256, 24 a second"},
                       {"not shown", "5 bins around multiples of a quarter of a cycle a frame"}}};
}

const Registration wheel_chart = register_chart({
    .name = "sampling/wagon_wheel",
    .title = "How fast a filmed wheel seems to turn",
    .x = {.label = "turn", .unit = "rad/s", .logarithmic = false},
    .y = {.label = "apparent turn", .unit = "rad/s", .logarithmic = false},
    .produce = wagon_wheel,
});

}  // namespace
}  // namespace parity
