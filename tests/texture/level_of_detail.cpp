#include <cmath>
#include <limits>
#include <numbers>

#include "cpu_reference/texture/anisotropic.h"
#include "cpu_reference/texture/mip_pyramid.h"
#include "cpu_reference/texture/sample.h"
#include "gpu/texture/sample.h"
#include "tests/chart.h"
#include "tests/texture/textures.h"

/// Where one level of detail cannot be right: footprints that are longer than wide, and turned on
/// the screen.
namespace parity {
namespace {

constexpr int side = 256;

/// An ellipse with a minor half axis of two texels, turned by `degrees` on the screen.
TextureFootprint turned_footprint(double ratio, double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  const dvec2 dx{2 * ratio * std::cos(angle), 2 * std::sin(angle)};
  const dvec2 dy{-2 * ratio * std::sin(angle), 2 * std::cos(angle)};
  return {{0.3f, 0.3f}, vec2(dx / double(side)), vec2(dy / double(side))};
}

/// Our sampler's level of detail against the logarithm of the ellipse's major half axis.
double level_error(gpu::Context& context, double ratio, double degrees) {
  const std::vector<Grid<u8vec4>> levels = texture_test::level_steps(side, 16);
  const TextureFootprint f[] = {turned_footprint(ratio, degrees)};
  const double level = gpu::sample(context, {levels, false, {}}, f, 0.5f)[0].x * 255.0 / 16;
  return std::abs(level - std::log2(2 * ratio));
}

/// The angle at which the longer derivative is a quarter level shorter than the axis:
/// cos^2 + sin^2 / ratio^2 = 2^-1/2. None above 45 degrees, where the other derivative is longer.
double quarter_level(double ratio) {
  const double b2 = 1 / (ratio * ratio);
  const double cosine = std::sqrt((std::numbers::sqrt2 / 2 - b2) / (1 - b2));
  const double angle = std::acos(cosine) * 180 / std::numbers::pi;
  return angle <= 45 ? angle : std::numeric_limits<double>::quiet_NaN();
}

const Registration turned = register_map({
    .name = "texture/level_of_detail",
    .title = "Level of detail from derivatives against the footprint's true length",
    .x = {.name = "ratio", .low = 1, .high = 32, .logarithmic = true},
    .y = {.name = "angle", .unit = "degrees", .low = 0, .high = 90},
    .value_label = "error",
    .value_unit = "levels",
    .logarithmic = false,
    .border = 0.25,
    .value = level_error,
    .theory = {{"cos^2 + sin^2 / ratio^2 = 2^-1/2", quarter_level},
               {"the same mirrored", [](double ratio) { return 90 - quarter_level(ratio); }}},
});

/// Root of the mean square difference from the elliptical weighted average, of noise.
double filter_error(gpu::Context& context, double ratio, double most) {
  static const std::vector<Grid<u8vec4>> levels = [] {
    Random random{3};
    return cpu::mip_pyramid(texture_test::random_image(side, side, random), false);
  }();
  Random random{11};
  std::vector<TextureFootprint> footprints;
  for (int i = 0; i < 48; ++i) {
    TextureFootprint f = turned_footprint(ratio, random.uniform(0, 90));
    f.uv = {random.uniform(), random.uniform()};
    footprints.push_back(f);
  }
  const MippedTexture texture{levels, false, {.max_anisotropy = int(std::lround(most))}};
  const std::vector<vec4> colors = gpu::sample(context, texture, footprints, 0.5f);
  double sum = 0, spread = 0;
  for (std::size_t i = 0; i < footprints.size(); ++i) {
    const TextureFootprint& f = footprints[i];
    const dvec4 truth =
        cpu::elliptical_weighted_average(texture, {dvec2(f.uv), dvec2(f.uv_dx), dvec2(f.uv_dy)});
    sum += std::pow(glm::length(dvec3(colors[i]) - dvec3(truth)), 2);
    spread += std::pow(glm::length(dvec3(truth) - 0.5), 2);
  }
  return std::sqrt(sum / spread);
}

const Registration too_long = register_map({
    .name = "texture/anisotropic",
    .title = "What is lost of noise where footprints are longer than the filter follows",
    .x = {.name = "ratio", .low = 1, .high = 32, .logarithmic = true},
    .y = {.name = "max_anisotropy", .low = 1, .high = 16, .logarithmic = true},
    .value_label = "error over the spread of the truth",
    .logarithmic = false,
    .border = 0.5,
    .value = filter_error,
    .theory = {{"max. anisotropy = ratio", [](double ratio) { return ratio; }}},
});

}  // namespace
}  // namespace parity
