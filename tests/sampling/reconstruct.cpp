#include "cpu_reference/sampling/reconstruct.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "cpu_reference/sampling/spectrum.h"
#include "geometry/random.h"
#include "gpu/sampling/reconstruct.h"
#include "gpu/sampling/spectrum.h"
#include "tests/chart.h"
#include "tests/stage.h"
#include "tests/statistics.h"

namespace parity {
namespace {

struct ReconstructionProblem {
  Grid<vec4> picture;
  ivec2 size{1};
  ReconstructionFilter filter = ReconstructionFilter::box;
};
auto fields_of(const ReconstructionProblem*) {
  return std::tuple{&ReconstructionProblem::picture, &ReconstructionProblem::size,
                    &ReconstructionProblem::filter};
}

ReconstructionProblem random_picture(const Setting& setting) {
  ReconstructionProblem p;
  const int side = setting.count("side");
  p.picture = {side, std::max(1, side - 3)};
  Random random{setting.seed};
  for (vec4& v : p.picture)
    v = {random.uniform(), random.uniform(), random.uniform(), random.uniform()};
  p.size = {std::max(1, int(side * setting.at("scale"))),
            std::max(1, int((side + 5) * setting.at("scale")))};
  p.filter = ReconstructionFilter(setting.count("filter"));
  return p;
}

Grid<dvec4> in_double(const Grid<vec4>& values) {
  Grid<dvec4> result{values.width(), values.height()};
  for (std::size_t i = 0; i < values.size(); ++i) result.values()[i] = dvec4(values.values()[i]);
  return result;
}

double largest_component(const Grid<dvec4>& got, const Grid<dvec4>& want) {
  double worst = 0;
  for (std::size_t i = 0; i < want.size(); ++i)
    for (int c = 0; c < 4; ++c)
      worst = std::max(worst, std::abs(got.values()[i][c] - want.values()[i][c]));
  return worst;
}

/// Of values at most 1: each of two passes adds at most L n 2^-24 for n taps and L 20 2^-23 for the
/// weights, and a filter makes errors at most L times larger; L, the sum of |weights| over the sum,
/// is at most 1.6.
double rounding_bound(const ReconstructionProblem& p) {
  const double ratio =
      std::max({1.0, double(p.picture.width()) / p.size.x, double(p.picture.height()) / p.size.y});
  const double taps = 2 * filter_radius(p.filter) * ratio + 1;
  return 2 * 1.6 * 1.6 * (taps + 40) * 0x1p-24;
}

const Registration registration = register_stage<ReconstructionProblem, Grid<dvec4>>({
    .name = "sampling/reconstruct",
    .title = "A picture at another size: box, tent, Gaussian, Mitchell, Lanczos",
    .source = "notes 1.8; Mitchell & Netravali 1988; Duchon 1979",
    .rows = {17, 20},
    .axes = {{.name = "filter", .low = 0, .high = 4, .standard = 4, .whole = true, .each = true},
             {.name = "scale", .low = 0.11, .high = 4, .standard = 0.7, .logarithmic = true},
             {.name = "side",
              .unit = "px",
              .low = 1,
              .high = 131,
              .standard = 64,
              .logarithmic = true,
              .whole = true}},
    .problem = random_picture,
    .cpu = {{.solve =
                 [](const ReconstructionProblem& p) {
                   return cpu::reconstruct(in_double(p.picture), p.size, p.filter);
                 }}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const ReconstructionProblem& p) {
                   return in_double(gpu::reconstruct(context, p.picture, p.size, p.filter));
                 }}},
    .distance = largest_component,
    .tolerance = rounding_bound,
    .why = "two passes of n taps: n 2^-24 for the sum and 20 2^-23 for weights by exp and sine, "
           "times the filter's sum of magnitudes (1.6 for Lanczos), which the second pass applies "
           "to the errors of the first too",
    .chart_axes = {"side"},
});

/// Gain of a filter at whole multiples of 1 / 16 cycles a pixel: an impulse, 32 times magnified on
/// the device, transformed on the device.
std::vector<double> measured_spectrum(gpu::Context& context, ReconstructionFilter filter) {
  constexpr int texels = 16, magnified = 32;
  Grid<vec4> impulse{texels, 1};
  impulse(texels / 2, 0) = vec4(1);
  const Grid<vec4> response = gpu::reconstruct(context, impulse, {texels * magnified, 1}, filter);
  Grid<vec2> signal{response.width(), 1};
  for (int x = 0; x < response.width(); ++x) signal(x, 0) = {response(x, 0).x / magnified, 0};
  const Grid<vec2> spectrum = gpu::fourier_transform(context, signal, false);
  std::vector<double> gains;
  for (int u = 0; u <= 3 * texels; ++u) {
    // The impulse stands half a texel right of the middle.
    const double turn = 2 * std::acos(-1.0) * u * (texels / 2 + 0.5 - 0.5 / magnified) / texels;
    gains.push_back(spectrum(u, 0).x * std::cos(turn) - spectrum(u, 0).y * std::sin(turn));
  }
  return gains;
}

/// What the samples of the response, 32 a px, must have: its spectrum, repeated every 32 cycles.
double sampled_spectrum(ReconstructionFilter filter, double f) {
  double sum = cpu::filter_spectrum(filter, f);
  for (int k = 1; k <= 40; ++k)
    sum += cpu::filter_spectrum(filter, f - 32 * k) + cpu::filter_spectrum(filter, f + 32 * k);
  return sum;
}

ChartData filter_spectra(gpu::Context& context) {
  ChartData data;
  std::vector<Series> theories;
  double worst = 0;
  for (const ReconstructionFilter filter : all_reconstruction_filters) {
    Series measured{name_of(filter) + ", device", {}};
    Series theory{name_of(filter) + ", closed form", {}, Series::Kind::theory};
    const std::vector<double> gains = measured_spectrum(context, filter);
    for (std::size_t u = 0; u < gains.size(); ++u) {
      const double f = double(u) / 16;
      measured.points.push_back({f, gains[u]});
      worst = std::max(worst, std::abs(gains[u] - sampled_spectrum(filter, f)));
    }
    for (int i = 0; i <= 240; ++i)
      theory.points.push_back({i / 80.0, cpu::filter_spectrum(filter, i / 80.0)});
    data.series.push_back(measured);
    theories.push_back(theory);
  }
  data.series.insert(data.series.end(), theories.begin(), theories.end());
  // A pixel's weights are divided by their sum, which ripples with the place between texels by
  // twice the gain at 1 cycle a pixel: by 0.0072 either way for the Gaussian, less for the others.
  data.assertions = {{"farthest from the closed form", worst, 0.01}};
  data.settings = {{"measured", "impulse, magnified 32 times, transformed"}};
  return data;
}

const Registration spectra_chart = register_chart({
    .name = "sampling/filter_spectra",
    .title = "What a filter lets through",
    .x = {.label = "frequency", .unit = "px⁻¹", .logarithmic = false},
    .y = {.label = "gain", .logarithmic = false},
    .produce = filter_spectra,
});

/// A sum of cosines of all frequencies up to `band` cycles a texel, at places of a texel's grid.
Grid<vec4> band_limited(int texels, int a_texel, double band) {
  Grid<vec4> picture{texels * a_texel, 8};
  for (int x = 0; x < picture.width(); ++x) {
    const double at = (x + 0.5) / a_texel - texels / 2.0;
    double sum = 0;
    for (int i = 1; i <= 12; ++i) sum += std::cos(2 * std::acos(-1.0) * band * i / 12 * at + i * i);
    for (int y = 0; y < picture.height(); ++y) picture(x, y) = vec4(float(0.5 + sum / 24));
  }
  return picture;
}

/// RMSE of a magnification by 4 away from the borders.
double magnification_error(const Grid<vec4>& got, const Grid<vec4>& want, int border) {
  double sum = 0;
  for (int x = border; x < want.width() - border; ++x)
    sum += std::pow(double(got(x, 4).x) - double(want(x, 4).x), 2);
  return std::sqrt(sum / (want.width() - 2 * border));
}

ChartData error_against_cost(gpu::Context& context) {
  constexpr int texels = 512, magnified = 4, rows = 8;
  const Grid<vec4> source = band_limited(texels, 1, 0.25);
  const Grid<vec4> truth = band_limited(texels, magnified, 0.25);
  ChartData data;
  std::vector<double> errors;
  for (const ReconstructionFilter filter : all_reconstruction_filters) {
    gpu::Reconstruction reconstruction(context, {texels, rows}, {texels * magnified, rows}, filter);
    const gpu::Buffer<vec4> from(context, source.values());
    const gpu::Buffer<vec4> to(context, truth.size());
    std::vector<double> times;
    for (int i = 0; i < 30; ++i)
      times.push_back(
          context.run([&](gpu::Commands& commands) { reconstruction.record(commands, from, to); })
              .seconds *
          1e3);
    Grid<vec4> got{texels * magnified, rows};
    got.values() = to.read();
    errors.push_back(magnification_error(got, truth, 8 * magnified));
    data.series.push_back({name_of(filter), {{median(times), errors.back(), name_of(filter)}}});
  }
  data.assertions = {{"error of Mitchell over error of box", errors[3] / errors[0], 0.6},
                     {"error of Lanczos over error of tent", errors[4] / errors[1], 0.5}};
  data.settings = {{"signal", "12 cosines up to 1/4 cycle a texel"},
                   {"size", "512x8 texels to 2048x8"}};
  return data;
}

const Registration cost_chart = register_chart({
    .name = "sampling/filter_error",
    .title = "Magnifying a band-limited signal: error against device time",
    .x = {.label = "time", .unit = "ms"},
    .y = {.label = "RMSE"},
    .produce = error_against_cost,
    .pareto = true,
});

/// Contrast of what a striped texture becomes on 128 pixels and should not: the strongest frequency
/// that is not the stripes' own. Without a filter: the nearest texel.
double moire_contrast(gpu::Context& context, double texels, double stripes,
                      std::optional<ReconstructionFilter> filter) {
  constexpr int pixels = 128;
  const int count = int(std::lround(texels));
  Grid<vec4> texture{count, 1};
  const Grid<double> wave = grating(count, 1, {stripes / count, 0});
  for (int x = 0; x < count; ++x) texture(x, 0) = vec4(float(wave(x, 0)));
  Grid<double> shown{pixels, 1};
  const Grid<vec4> resampled =
      gpu::reconstruct(context, texture, {pixels, 1}, filter.value_or(ReconstructionFilter::box));
  for (int x = 0; x < pixels; ++x)
    shown(x, 0) =
        double(filter ? resampled(x, 0).x : texture(int((x + 0.5) * count / pixels), 0).x);
  const Grid<dvec2> signal = cpu::windowed(shown);
  double worst = 0;
  for (const auto& peak : cpu::spectrum_peaks(cpu::fourier_transform(signal, false), 8)) {
    const bool is_true = std::abs(peak.frequency.x * pixels - stripes) < 2;
    if (!is_true) worst = std::max(worst, 2 * peak.amplitude);
  }
  return worst;
}

Map moire_map(std::optional<ReconstructionFilter> filter, const std::string& name,
              const std::string& title) {
  return {.name = "sampling/moire_" + name,
          .title = title,
          .x = {.name = "texture size",
                .unit = "texel",
                .low = 32,
                .high = 2048,
                .standard = 512,
                .logarithmic = true,
                .whole = true},
          .y = {.name = "stripes across the texture",
                .low = 8,
                .high = 1000,
                .standard = 64,
                .logarithmic = true},
          .value_label = "contrast of false stripes",
          .logarithmic = false,
          .border = 0.1,
          .columns = 24,
          .rows = 24,
          .value = [filter](
                       gpu::Context& context, double texels,
                       double stripes) { return moire_contrast(context, texels, stripes, filter); },
          .theory = {{"half the pixels", [](double) { return 64.0; }},
                     {"half the texels", [](double texels) { return texels / 2; }}}};
}

const Registration nearest_map = register_map(
    moire_map(std::nullopt, "nearest", "False stripes of a texture on 128 pixels, nearest texel"));
const Registration lanczos_map =
    register_map(moire_map(ReconstructionFilter::lanczos, "lanczos",
                           "False stripes of a texture on 128 pixels, Lanczos as wide as a pixel"));

}  // namespace
}  // namespace parity
