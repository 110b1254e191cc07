#include "cpu_reference/sampling/spectrum.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "cpu_reference/sampling/reconstruct.h"
#include "geometry/flip.h"
#include "geometry/image_io.h"
#include "geometry/sampling.h"
#include "gpu/core/context.h"
#include "gpu/sampling/reconstruct.h"
#include "gpu/sampling/spectrum.h"
#include "tools/bad_option.h"
#include "tools/options.h"
#include "tools/verb.h"

namespace parity::tools {
namespace {

constexpr int largest_side = 4096;    ///< of what is transformed: 16 million complex numbers
constexpr double darkest_db = -80.0;  ///< of the strongest frequency; black in the picture

struct Options {
  std::string input;
  std::string output;
  std::string grating;
  std::string filter = "none";
  std::string window = "gaussian";
  std::string backend = "gpu";
  std::string device;
  double zone_plate = 0;
  double scale = 1;
  int size = 512;
  int peaks = 5;
  bool json = false;
};

/// What is transformed: grey, linear; and what was sampled, if that is known.
struct Signal {
  Grid<vec4> picture;
  std::string name;
};

Grid<vec4> as_picture(const Grid<double>& grey) {
  Grid<vec4> picture{grey.width(), grey.height()};
  for (std::size_t i = 0; i < grey.size(); ++i)
    picture.values()[i] = vec4(vec3(float(grey.values()[i])), 1);
  return picture;
}

/// Luminance by the primaries of sRGB.
Grid<double> grey_of(const Grid<vec4>& picture) {
  Grid<double> grey{picture.width(), picture.height()};
  for (std::size_t i = 0; i < picture.size(); ++i) {
    const dvec3 c{picture.values()[i]};
    grey.values()[i] = 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z;
    if (!std::isfinite(grey.values()[i])) grey.values()[i] = 0;
  }
  return grey;
}

dvec2 parse_grating(const std::string& text) {
  dvec2 f{0.0};
  char rest = 0;
  if (std::sscanf(text.c_str(), "%lf,%lf%c", &f.x, &f.y, &rest) != 2 || !(glm::length(f) <= 1e6))
    throw bad_option("grating", text, "FX,FY in cycles a pixel, such as 0.8,0");
  return f;
}

Signal make_signal(const Options& options) {
  const int given =
      int(!options.input.empty()) + int(!options.grating.empty()) + int(options.zone_plate > 0);
  if (given != 1)
    throw std::invalid_argument(
        "spectrum: expected one of PICTURE, --zone-plate and --grating, got " +
        std::to_string(given));
  if (!options.input.empty()) return {load_image(options.input), options.input};
  if (!options.grating.empty())
    return {as_picture(parity::grating(options.size, options.size, parse_grating(options.grating))),
            "grating " + options.grating};
  return {as_picture(parity::zone_plate(options.size, options.size, 2 * options.zone_plate)),
          "zone plate"};
}

/// The picture's pixel, of the source's grid, that each pixel of the result stands for.
Grid<vec4> take_nearest(const Grid<vec4>& from, ivec2 size) {
  Grid<vec4> to{size.x, size.y};
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x)
      to(x, y) =
          from(int((x + 0.5) * from.width() / size.x), int((y + 0.5) * from.height() / size.y));
  return to;
}

ReconstructionFilter filter_named(const std::string& name) {
  for (const ReconstructionFilter filter : all_reconstruction_filters)
    if (name_of(filter) == name) return filter;
  throw bad_option("filter", name, "none, box, tent, gaussian, mitchell or lanczos");
}

template <typename To, typename From>
Grid<To> converted(const Grid<From>& from) {
  Grid<To> to{from.width(), from.height()};
  std::ranges::transform(from, to.begin(), [](const From& value) { return To(value); });
  return to;
}

/// The two things that both backends do.
struct Backend {
  explicit Backend(const Options& options) {
    if (options.backend == "gpu") context.emplace(gpu::ContextOptions{.device = options.device});
  }

  Grid<vec4> resampled(const Grid<vec4>& picture, ivec2 size, ReconstructionFilter filter) {
    if (context) return gpu::reconstruct(*context, picture, size, filter);
    return converted<vec4>(cpu::reconstruct(converted<dvec4>(picture), size, filter));
  }

  Grid<dvec2> transformed(const Grid<dvec2>& signal) {
    if (context)
      return converted<dvec2>(gpu::fourier_transform(*context, converted<vec2>(signal), false));
    return cpu::fourier_transform(signal, false);
  }

  std::optional<gpu::Context> context;
};

ivec2 scaled_size(const Signal& signal, double scale) {
  const auto side = [&](int count) { return std::max(1.0, std::round(count * scale)); };
  const double width = side(signal.picture.width()), height = side(signal.picture.height());
  if (width > largest_side || height > largest_side)
    throw std::invalid_argument(fmt::format(
        "spectrum: {} would be {}x{} px, must be at most {} a side; --scale makes it smaller",
        signal.name, width, height, largest_side));
  return {int(width), int(height)};
}

Grid<vec4> scaled(Backend& backend, const Signal& signal, const Options& options) {
  const ivec2 size = scaled_size(signal, options.scale);
  if (options.scale == 1) return signal.picture;
  return options.filter == "none"
             ? take_nearest(signal.picture, size)
             : backend.resampled(signal.picture, size, filter_named(options.filter));
}

Grid<dvec2> signal_of(const Grid<double>& grey, const std::string& window) {
  if (window == "gaussian") return cpu::windowed(grey);
  double sum = 0;
  for (const double value : grey) sum += value;
  const double mean = sum / double(grey.size());
  Grid<dvec2> signal{grey.width(), grey.height()};
  for (std::size_t i = 0; i < grey.size(); ++i) signal.values()[i] = {grey.values()[i] - mean, 0};
  return signal;
}

/// Frequency 0 in the middle, the strongest frequency 1, darkest_db of it 0.
Grid<float> levels(const Grid<dvec2>& spectrum) {
  const int w = spectrum.width(), h = spectrum.height();
  double strongest = 0;
  for (const dvec2& value : spectrum) strongest = std::max(strongest, glm::length(value));
  Grid<float> result{w, h};
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const dvec2 value = spectrum((x + w - w / 2) % w, (y + h - h / 2) % h);
      const double share = strongest > 0 ? glm::length(value) / strongest : 0;
      const double db = 20 * std::log10(std::max(share, 1e-30));
      result(x, y) = float(std::clamp(1 - db / darkest_db, 0.0, 1.0));
    }
  return result;
}

/// The picture, and beside it its spectrum.
Grid<u8vec4> side_by_side(const Grid<vec4>& picture, const Grid<dvec2>& spectrum) {
  constexpr int gap = 8;
  const Grid<u8vec4> left = display_image(picture), right = magma(levels(spectrum));
  Grid<u8vec4> sheet{2 * left.width() + gap, left.height(), u8vec4(255)};
  for (int y = 0; y < left.height(); ++y)
    for (int x = 0; x < left.width(); ++x) {
      sheet(x, y) = left(x, y);
      sheet(left.width() + gap + x, y) = right(x, y);
    }
  return sheet;
}

struct Found {
  ivec2 size{0};
  std::vector<cpu::SpectrumPeak> peaks;
};

/// From the x axis, y down as in the picture, degrees.
double direction(dvec2 f) { return std::atan2(f.y, f.x) * 180 / std::numbers::pi; }

/// What samples at whole pixels show of a frequency, x >= 0.
dvec2 alias(dvec2 f) {
  const dvec2 shown{std::remainder(f.x, 1.0), std::remainder(f.y, 1.0)};
  return (shown.x < 0 ? -shown : shown) + 0.0;
}

/// Samples may fall on the zeros of a grating that they show with half a cycle a pixel.
bool hangs_on_phase(dvec2 shown) {
  return shown != dvec2(0.0) && glm::round(2.0 * shown) == 2.0 * shown;
}

struct SampledGrating {
  dvec2 frequency;  ///< cycles a pixel of the picture that is transformed
  dvec2 shown;      ///< what its samples look like
};

std::optional<SampledGrating> grating_of(const Options& options, const Found& found) {
  if (options.grating.empty()) return std::nullopt;
  const dvec2 f = parse_grating(options.grating) * double(options.size) / dvec2(found.size);
  return SampledGrating{f, alias(f)};
}

/// Peaks that are more than sidelobes of the strongest.
std::vector<cpu::SpectrumPeak> clear_peaks(const Grid<dvec2>& spectrum, int count) {
  constexpr double sidelobes = 1e-3;  // of cpu::windowed
  std::vector<cpu::SpectrumPeak> peaks = cpu::spectrum_peaks(spectrum, count);
  std::erase_if(peaks, [least = peaks.empty() ? 0 : sidelobes * peaks[0].amplitude](
                           const cpu::SpectrumPeak& peak) { return peak.amplitude < least; });
  return peaks;
}

/// To the five digits that are printed, without -0.
double five_digits(double value) { return std::round(value * 1e5) / 1e5 + 0.0; }

void print(const Options& options, const Signal& signal, const Found& found) {
  std::printf("%s: %dx%d px\n", signal.name.c_str(), found.size.x, found.size.y);
  if (const auto grating = grating_of(options, found)) {
    const auto& [f, shown] = *grating;
    std::printf("a grating of (%.6g, %.6g) cycles a pixel looks like (%.6g, %.6g)%s\n", f.x, f.y,
                shown.x, shown.y,
                hangs_on_phase(shown) ? ", as strong or faint as its phase has it" : "");
  }
  if (options.peaks == 0) return;
  if (found.peaks.empty()) {
    std::printf("no frequency but 0\n");
    return;
  }
  std::printf("cycles a pixel        length     period     direction  amplitude\n");
  for (const cpu::SpectrumPeak& peak : found.peaks) {
    const double f = glm::length(peak.frequency);
    std::printf("(%8.5f, %8.5f)  %8.5f  %8.3f px  %8.2f deg  %.6g\n", five_digits(peak.frequency.x),
                five_digits(peak.frequency.y), f, f > 0 ? 1 / f : 0.0,
                five_digits(direction(peak.frequency)), peak.amplitude);
  }
}

void print_json(const Options& options, const Signal& signal, const Found& found) {
  nlohmann::json peaks = nlohmann::json::array();
  for (const cpu::SpectrumPeak& peak : found.peaks)
    peaks.push_back({{"frequency", {peak.frequency.x, peak.frequency.y}},
                     {"direction_degrees", direction(peak.frequency)},
                     {"amplitude", peak.amplitude}});
  nlohmann::json json = {{"version", 1},
                         {"input", signal.name},
                         {"width", found.size.x},
                         {"height", found.size.y},
                         {"scale", options.scale},
                         {"filter", options.filter},
                         {"window", options.window},
                         {"backend", options.backend},
                         {"peaks", peaks}};
  if (const auto grating = grating_of(options, found)) {
    json["grating"] = {grating->frequency.x, grating->frequency.y};
    json["looks_like"] = {grating->shown.x, grating->shown.y};
  }
  std::printf("%s\n", json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
}

void check(const Options& options) {
  check_device(options.backend, options.device);
  if (options.output.empty()) return;
  const std::filesystem::path output = options.output;
  if (output.extension() != ".png") throw bad_option("output", options.output, "a name with .png");
  std::error_code error;
  if (!options.input.empty() && std::filesystem::equivalent(output, options.input, error))
    throw bad_option("output", options.output, "another file than the input");
}

int run(const Options& options) {
  check(options);
  const Signal signal = make_signal(options);
  Backend backend(options);
  const Grid<vec4> picture = scaled(backend, signal, options);
  const Grid<dvec2> spectrum = backend.transformed(signal_of(grey_of(picture), options.window));
  if (!options.output.empty()) save_png(options.output, side_by_side(picture, spectrum));
  const Found found{{picture.width(), picture.height()}, clear_peaks(spectrum, options.peaks)};
  if (options.json)
    print_json(options, signal, found);
  else
    print(options, signal, found);
  return 0;
}

}  // namespace

void add_spectrum_verb(CLI::App& app, int& exit_code) {
  CLI::App* verb =
      app.add_subcommand("spectrum", "Draw a picture's spectrum; see what sampling does to it");
  const auto o = std::make_shared<Options>();
  CLI::Option* picture =
      verb->add_option("PICTURE", o->input, "PNG, JPEG, HDR, EXR or PFM; its luminance counts");
  verb->add_option(
          "--zone-plate", o->zone_plate,
          "Instead: rings whose frequency grows from 0 to this, cycles a pixel, at the sides")
      ->check(within(1e-6, 1e6));
  verb->add_option("--grating", o->grating, "Instead: a cosine of FX,FY cycles a pixel");
  verb->add_option("--size", o->size, "Side of what is drawn instead, px")
      ->check(CLI::Range(8, largest_side))
      ->excludes(picture)
      ->capture_default_str();
  CLI::Option* scale = verb->add_option("--scale", o->scale, "Resample first, by this factor")
                           ->check(within(1e-3, 1e3));
  verb->add_option("--filter", o->filter, "Of the resampling: none takes the nearest pixel")
      ->check(CLI::IsMember({"none", "box", "tent", "gaussian", "mitchell", "lanczos"}))
      ->needs(scale)
      ->capture_default_str();
  verb->add_option("--window", o->window,
                   "gaussian: looks at the middle, sharp peaks; none: at all, as if it repeated")
      ->check(CLI::IsMember({"gaussian", "none"}))
      ->capture_default_str();
  verb->add_option("--peaks", o->peaks, "How many frequencies to print, strongest first")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  verb->add_option("-o,--output", o->output,
                   "PNG of the picture and, beside it, its spectrum: frequency 0 in the middle,\n"
                   "1/2 cycle a pixel at the borders, 80 dB from yellow to black");
  verb->add_option("--backend", o->backend, "gpu: Vulkan; cpu: the reference alone")
      ->check(CLI::IsMember({"gpu", "cpu"}))
      ->capture_default_str();
  verb->add_option("--device", o->device, "Name or index of a device");
  verb->add_flag("--json", o->json, "Machine-readable output");
  verb->footer(
      "Examples:\n"
      "  parity spectrum --grating 0.8,0          # 0.8 cycles a pixel looks like 0.2\n"
      "  parity spectrum --zone-plate 0.75 -o rings.png\n"
      "  parity spectrum photo.jpg --scale 0.25 -o moire.png\n"
      "  parity spectrum photo.jpg --scale 0.25 --filter lanczos -o clean.png");
  verb->callback([o, &exit_code] { exit_code = run(*o); });
}

}  // namespace parity::tools
