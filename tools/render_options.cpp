#include "tools/render_options.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "geometry/color.h"
#include "tools/bad_option.h"

namespace parity::tools {
ivec2 parse_size(const std::string& text) {
  int width = 0;
  int height = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) != 2)
    throw bad_option("size", text, "WIDTHxHEIGHT, for example 1920x1080");
  if (width < 1 || height < 1 || width > 16384 || height > 16384)
    throw bad_option("size", text, "from 1x1 to 16384x16384");
  return {width, height};
}

vec4 parse_background(const std::string& text) {
  const char* expected = "'transparent', '#rrggbb', '#rrggbbaa' (sRGB) or 'r,g,b[,a]' (linear)";
  if (text == "transparent") return vec4(0.0f);
  if (text.empty()) return parse_background("#2b2f36");
  if (!text.empty() && text[0] == '#') {
    if ((text.size() != 7 && text.size() != 9) ||
        text.find_first_not_of("0123456789abcdefABCDEF", 1) != std::string::npos)
      throw bad_option("background", text, expected);
    vec4 color{1.0f};
    for (std::size_t i = 0; 2 * i + 1 < text.size(); ++i) {
      const float code = float(std::stoi(text.substr(2 * i + 1, 2), nullptr, 16)) / 255.0f;
      color[int(i)] = i < 3 ? linear_from_srgb(code) : code;
    }
    return color;
  }
  vec4 color{1.0f};
  char rest = 0;
  const int count =
      std::sscanf(text.c_str(), "%f,%f,%f,%f%c", &color.x, &color.y, &color.z, &color.w, &rest);
  const bool finite = std::isfinite(color.x) && std::isfinite(color.y) && std::isfinite(color.z);
  if (count < 3 || count > 4 || !finite || !(color.w >= 0 && color.w <= 1))
    throw bad_option("background", text, expected);
  return color;
}

bool names_a_file(const std::string& environment) {
  return environment.find_first_not_of("0123456789.,eE+-") != std::string::npos;
}

std::optional<vec3> parse_environment(const std::string& text) {
  if (text.empty()) return std::nullopt;
  if (names_a_file(text)) return vec3(0.0f);
  vec3 color{0.0f};
  char rest = 0;
  const int count = std::sscanf(text.c_str(), "%f,%f,%f%c", &color.x, &color.y, &color.z, &rest);
  if (count == 1 && text.find(',') == std::string::npos) color = vec3(color.x);
  const bool right =
      (count == 1 && text.find_first_not_of("0123456789.eE+-") == std::string::npos) || count == 3;
  for (int i = 0; i < 3; ++i)
    if (!right || !(color[i] >= 0) || !std::isfinite(color[i]))
      throw bad_option("environment", text,
                       "a picture's file, or a radiance 'l' or 'r,g,b', linear and not negative");
  return color;
}

DepthMode parse_depth(const std::string& text) {
  if (text == "standard") return DepthMode::standard;
  if (text == "logarithmic") return DepthMode::logarithmic;
  return DepthMode::reverse_z;
}

ToneMap parse_tone_map(const std::string& text) {
  if (text == "neutral") return ToneMap::neutral;
  if (text == "aces") return ToneMap::aces;
  return text == "agx" ? ToneMap::agx : ToneMap::clamp;
}

std::optional<Antialiasing> antialiasing(const RenderArguments& arguments) {
  if (arguments.aa.empty()) {
    if (arguments.max_error) throw std::invalid_argument("--max-error is for --aa auto");
    return std::nullopt;
  }
  Antialiasing mode = parse_antialiasing(arguments.aa);
  const bool is_auto = mode.kind == Antialiasing::Kind::automatic;
  if (is_auto != arguments.max_error.has_value())
    throw std::invalid_argument(is_auto ? "--aa auto needs --max-error, a mean FLIP such as 0.002"
                                        : "--max-error is for --aa auto");
  if (is_auto) mode.max_error = *arguments.max_error;
  return mode;
}

void check_output(const RenderArguments& arguments) {
  if (arguments.output.empty()) {
    if (!arguments.dry_run) throw std::invalid_argument("render: -o OUTPUT is missing");
    return;
  }
  const std::filesystem::path output{arguments.output};
  const std::string extension = output.extension().string();
  if (extension != ".png" && extension != ".exr" && extension != ".hdr" && extension != ".pfm")
    throw bad_option("output", arguments.output, "a file named *.png, *.exr, *.hdr or *.pfm");
  std::error_code error;
  if (std::filesystem::equivalent(output, arguments.input, error))
    throw bad_option("output", arguments.output, "another file than the input");
}

}  // namespace parity::tools
