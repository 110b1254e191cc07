#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "geometry/atomic_file.h"
#include "geometry/color.h"
#include "geometry/flip.h"
#include "geometry/image_io.h"
#include "geometry/input_error.h"
#include "geometry/picture_difference.h"
#include "tools/options.h"
#include "tools/verb.h"

namespace parity::tools {
namespace {

struct Options {
  std::string a;
  std::string b;
  std::string output;
  std::string metric = "flip";
  std::optional<double> max_error;
  double pixels_per_degree = usual_pixels_per_degree;
  bool json = false;
};

struct Input {
  Grid<vec4> linear;
  bool is_display_referred = false;
};

struct Result {
  int width = 0;
  int height = 0;
  bool are_display_referred = false;
  PictureDifference difference;
  Grid<float> flip;
};

Input load(const std::string& path) {
  const std::vector<std::byte> bytes = read_file(path, max_image_bytes);
  return {decode_linear_image(bytes, path), is_display_referred(bytes)};
}

Grid<vec4> as_displayed(Grid<vec4> linear) {
  for (vec4& color : linear)
    for (int c = 0; c < 3; ++c) color[c] = srgb_from_linear(color[c]);
  return linear;
}

Result compare(const Options& options) {
  const Input a = load(options.a), b = load(options.b);
  const int width = a.linear.width(), height = a.linear.height();
  if (b.linear.width() != width || b.linear.height() != height)
    throw InputError(options.b, "size is " + std::to_string(b.linear.width()) + "x" +
                                    std::to_string(b.linear.height()) + ", expected " +
                                    std::to_string(width) + "x" + std::to_string(height) +
                                    " as of " + options.a);
  Result result;
  result.width = width;
  result.height = height;
  result.are_display_referred = a.is_display_referred && b.is_display_referred;
  result.difference = result.are_display_referred
                          ? difference(as_displayed(a.linear), as_displayed(b.linear))
                          : difference(a.linear, b.linear);
  const bool is_light = !a.is_display_referred && !b.is_display_referred;
  result.flip = is_light ? hdr_flip(a.linear, b.linear, options.pixels_per_degree)
                         : flip(a.linear, b.linear, options.pixels_per_degree);
  return result;
}

void print(const Result& result) {
  const PictureDifference& d = result.difference;
  std::printf("size     %dx%d, %s values\n", result.width, result.height,
              result.are_display_referred ? "display-referred" : "linear");
  std::printf("MSE      %.6g\n", d.mse);
  std::printf("PSNR     %.6g dB\n", d.psnr);
  std::printf("maximum  %.6g at (%d, %d)\n", d.maximum, d.maximum_x, d.maximum_y);
  std::printf("FLIP     %.6f\n", mean(result.flip));
}

void print_json(const Options& options, const Result& result, bool is_within) {
  const PictureDifference& d = result.difference;
  const nlohmann::json json = {{"version", 1},
                               {"a", options.a},
                               {"b", options.b},
                               {"width", result.width},
                               {"height", result.height},
                               {"values", result.are_display_referred ? "display" : "linear"},
                               {"mse", d.mse},
                               {"psnr_db", d.psnr},
                               {"max", d.maximum},
                               {"max_at", {d.maximum_x, d.maximum_y}},
                               {"flip", mean(result.flip)},
                               {"pixels_per_degree", options.pixels_per_degree},
                               {"equal", d.maximum == 0.0},
                               {"within", is_within}};
  std::printf("%s\n", json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
}

/// A PSNR grows as pictures come closer; the others shrink.
bool is_within(const Options& options, const Result& result) {
  if (!options.max_error) return true;
  const double limit = *options.max_error;
  if (options.metric == "mse") return result.difference.mse <= limit;
  if (options.metric == "psnr") return result.difference.psnr >= limit;
  if (options.metric == "max") return result.difference.maximum <= limit;
  return mean(result.flip) <= limit;
}

void check(const Options& options) {
  if (options.output.empty()) return;
  const std::filesystem::path output = options.output;
  if (output.extension() != ".png")
    throw std::invalid_argument("diff: --output " + options.output + " must end in .png");
  std::error_code error;
  for (const std::string& input : {options.a, options.b})
    if (std::filesystem::equivalent(output, input, error))
      throw std::invalid_argument("diff: --output " + options.output + " is an input");
}

int run(const Options& options) {
  check(options);
  const Result result = compare(options);
  const bool within = is_within(options, result);
  if (!options.output.empty()) save_png(options.output, magma(result.flip));
  if (options.json)
    print_json(options, result, within);
  else
    print(result);
  if (within) return 0;
  std::fprintf(stderr, "parity: diff: %s is not within %g\n", options.metric.c_str(),
               *options.max_error);
  return 1;
}

}  // namespace

void add_diff_verb(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand(
      "diff", "Compare two pictures (PNG, JPEG, HDR, EXR, PFM): MSE, PSNR, maximum, FLIP");
  const auto options = std::make_shared<Options>();
  verb->add_option("A", options->a, "The picture that is right")->required();
  verb->add_option("B", options->b, "The picture to judge")->required();
  verb->add_flag("--json", options->json, "Machine-readable output");
  verb->add_option("-o,--output", options->output,
                   "Write the FLIP of each pixel as a PNG: black 0, violet, red, yellow 1");
  verb->add_option("--max-error", options->max_error, "Exit with 1 if the metric is above this")
      ->check(within(-1e9, 1e9));
  verb->add_option("--metric", options->metric, "What --max-error limits; psnr: from below")
      ->check(CLI::IsMember({"mse", "psnr", "max", "flip"}))
      ->capture_default_str();
  verb->add_option("--pixels-per-degree", options->pixels_per_degree, "Of the viewer, for FLIP")
      ->check(within(1, 1000));
  verb->footer(
      "PNG and JPEG are compared by the values that they hold (0 to 1), others by linear values.\n"
      "FLIP is HDR-FLIP if neither is PNG or JPEG.\n"
      "Examples:\n  parity diff reference.png test.png -o error.png\n"
      "  parity diff a.exr b.exr --metric max --max-error 1e-4");
  verb->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace parity::tools
