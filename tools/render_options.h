#pragma once

#include <optional>
#include <string>

#include "geometry/camera.h"
#include "geometry/math.h"
#include "geometry/tone_map.h"
#include "tools/antialias.h"

/// What `parity render` is asked for, and what its options mean.
namespace parity::tools {

struct RenderArguments {
  std::string input;
  std::string output;
  std::string size = "1280x720";
  std::string camera;
  std::string backend = "gpu";
  std::string device;
  std::string background;
  std::string depth = "reverse";
  std::string metrics;
  std::string environment;
  std::string tone_map = "neutral";
  std::string shadows = "on";
  std::string ambient_occlusion = "off";
  double exposure = 0;
  int msaa = 4;
  std::string aa;
  std::optional<double> max_error;
  int threads = 0;
  bool dry_run = false;
  bool quiet = false;
  bool verbose = false;
};

/// "WIDTHxHEIGHT".
///
/// @throws std::invalid_argument  here and below: names the option, the value and what it must be.
ivec2 parse_size(const std::string& text);

/// "#rrggbb" or "#rrggbbaa" in sRGB, "r,g,b" or "r,g,b,a" in linear light, or "transparent"; empty:
/// a dark grey.
vec4 parse_background(const std::string& text);

/// Does it name a file? Numbers, commas and signs alone are a radiance.
bool names_a_file(const std::string& environment);

/// "l" or "r,g,b", linear and not negative; black for a file, nothing for nothing.
std::optional<vec3> parse_environment(const std::string& text);

DepthMode parse_depth(const std::string& text);
ToneMap parse_tone_map(const std::string& text);

/// What --aa asks for; none: it was not given.
std::optional<Antialiasing> antialiasing(const RenderArguments& arguments);

/// The output is there, of a known kind, and not the input.
void check_output(const RenderArguments& arguments);

}  // namespace parity::tools
