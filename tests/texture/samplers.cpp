#include <array>
#include <optional>

#include "cpu_reference/texture/answers.h"
#include "cpu_reference/texture/mip_pyramid.h"
#include "cpu_reference/texture/sample.h"
#include "gpu/texture/sample.h"
#include "tests/stage.h"
#include "tests/texture/textures.h"

/// The isotropic samplers: ours in software, and the device's own.
namespace parity {
namespace {

struct Lookups {
  std::vector<Grid<u8vec4>> levels;
  bool srgb = false;
  Sampler sampler;
  std::vector<TextureFootprint> footprints;
  gpu::Format format = gpu::Format::rgba8;  ///< of the device's image
  cpu::SamplerPrecision precision;
  int level_bits = 24;  ///< of the device's level of detail
  MippedTexture texture() const { return {levels, srgb, sampler}; }
};
auto fields_of(const Lookups*) { return std::tuple{&Lookups::levels, &Lookups::footprints}; }

constexpr std::array<Sampler, 6> samplers{{
    {.mag = Filter::nearest, .min = Filter::nearest, .mip = std::nullopt},
    {.mag = Filter::linear, .min = Filter::linear, .mip = std::nullopt},
    {.mag = Filter::linear, .min = Filter::linear, .mip = Filter::linear},
    {.mag = Filter::linear, .min = Filter::nearest, .mip = Filter::nearest},
    {.mag = Filter::nearest, .min = Filter::nearest, .mip = Filter::linear},
    {.mag = Filter::nearest, .min = Filter::linear, .mip = Filter::nearest},
}};

Lookups make_lookups(const Setting& setting, const Sampler& sampler, bool srgb) {
  Random random{setting.seed};
  const int side = setting.count("side");
  Lookups p;
  p.srgb = srgb;
  p.levels = cpu::mip_pyramid(texture_test::random_image(side, (side + 1) / 2, random), srgb);
  p.sampler = sampler;
  p.sampler.wrap_u = Wrap(setting.count("wrap"));
  p.sampler.wrap_v = Wrap((setting.count("wrap") + 1) % 5);
  p.footprints = texture_test::random_footprints(side, (side + 1) / 2, 4000, random);
  p.precision.coordinate = 0x1p-22;
  return p;
}

/// Levels of detail that float arithmetic may give.
cpu::LevelRange float_levels(const Lookups& p, const TextureFootprint& f) {
  const double lambda = cpu::level_of_detail(dvec2(f.uv_dx), dvec2(f.uv_dy), p.levels[0].width(),
                                             p.levels[0].height());
  const double error = 0x1p-21 + 6 * 0x1p-24 * std::abs(lambda);
  return {lambda - error, lambda + error};
}

double worst(const Lookups& p, const std::vector<dvec4>& got,
             const std::function<cpu::LevelRange(const TextureFootprint&)>& levels) {
  double largest = 0;
  for (std::size_t i = 0; i < got.size(); ++i) {
    const TextureFootprint& f = p.footprints[i];
    const auto answers = cpu::sample_answers(p.texture(), dvec2(f.uv), levels(f), p.precision);
    largest = std::max(largest, cpu::distance_to(answers, got[i]));
  }
  return largest;
}

std::vector<dvec4> sample_all(const Lookups& p) {
  std::vector<dvec4> colors;
  for (const TextureFootprint& f : p.footprints)
    colors.push_back(cpu::sample(p.texture(), dvec2(f.uv),
                                 cpu::level_of_detail(dvec2(f.uv_dx), dvec2(f.uv_dy),
                                                      p.levels[0].width(), p.levels[0].height()))
                         .value);
  return colors;
}

std::vector<dvec4> widened(const std::vector<vec4>& colors) {
  return {colors.begin(), colors.end()};
}

std::vector<Axis> with_sampler_axes(std::vector<Axis> axes) {
  axes.push_back({.name = "side",
                  .unit = "texel",
                  .low = 1,
                  .high = 257,
                  .standard = 131,
                  .logarithmic = true,
                  .whole = true});
  axes.push_back({.name = "wrap", .low = 0, .high = 4, .standard = 0, .whole = true, .each = true});
  return axes;
}

Registration software_sampler(const std::string& name, const std::string& title,
                              std::vector<int> rows, const Sampler& sampler) {
  return register_stage<Lookups, std::vector<dvec4>>({
      .name = name,
      .title = title,
      .source = "notes 6.3; Vulkan 1.3, Texel Filtering",
      .rows = std::move(rows),
      .axes = with_sampler_axes(
          {{.name = "srgb", .low = 0, .high = 1, .standard = 0, .whole = true, .each = true}}),
      .problem =
          [sampler](const Setting& setting) {
            return make_lookups(setting, sampler, setting.count("srgb") != 0);
          },
      .cpu = {{.solve = [](const Lookups& p) { return sample_all(p); }}},
      .gpu = {{.solve =
                   [](gpu::Context& context, const Lookups& p) {
                     return widened(gpu::sample(context, p.texture(), p.footprints, 0.5f));
                   }}},
      .distance =
          [](const Lookups& p, const std::vector<dvec4>& got, const std::vector<dvec4>&) {
            return worst(p, got, [&](const TextureFootprint& f) { return float_levels(p, f); });
          },
      .tolerance = 16 * 0x1p-24,
      .why = "outside of the answers that coordinates off by 2^-22 of their size in texels and "
             "levels of detail off by 2^-21 + 6 |lambda| 2^-24 can give: seven products and sums a "
             "level, two levels, of values up to 1",
      .chart_axes = {"side"},
  });
}

const Registration nearest =
    software_sampler("texture/nearest", "The texel that holds the point", {110}, samplers[0]);
const Registration bilinear = software_sampler(
    "texture/bilinear", "Four texels, mixed by their distance", {110, 111}, samplers[1]);
const Registration trilinear = software_sampler(
    "texture/trilinear", "Two mip levels, mixed by the level of detail of the pixel's footprint",
    {113, 114}, samplers[2]);

Lookups for_hardware(const Setting& setting, const gpu::DeviceInfo& device, gpu::Format format) {
  Lookups p = make_lookups(setting, samplers[std::size_t(setting.count("filter"))],
                           format == gpu::Format::rgba8_srgb);
  p.format = format;
  p.precision.texel_weight = std::exp2(-device.subtexel_bits);
  p.precision.level_weight = std::exp2(-device.mipmap_bits);
  p.precision.srgb_decode = 0.5;
  p.level_bits = device.mipmap_bits;
  return p;
}

/// Mixes that a lookup goes through one after the other: along u, along v, between levels.
int mixes(const Sampler& s) {
  const bool in_a_level = s.mag == Filter::linear || s.min == Filter::linear;
  return (in_a_level ? 2 : 0) + (s.mip == Filter::linear ? 1 : 0);
}

/// Floats round as in software; 8-bit formats may be filtered in 8 bits, which rounds after each
/// mix. The nearest texel of the nearest level is exact.
double hardware_tolerance(const Lookups& p) {
  const double in_floats = 16 * 0x1p-24;
  return p.format == gpu::Format::rgba32_float ? in_floats
                                               : in_floats + 0.5 / 255 * mixes(p.sampler);
}

std::vector<dvec4> sample_by_hardware(gpu::Context& context, const Lookups& p) {
  try {
    return widened(gpu::hardware_sample(context, p.texture(), p.footprints, p.format));
  } catch (const gpu::Error& error) {
    if (error.kind() == gpu::ErrorKind::missing_feature) throw Unsupported(error.what());
    throw;
  }
}

Registration fixed_function(const std::string& name, const std::string& format_name,
                            gpu::Format format) {
  return register_stage<Lookups, std::vector<dvec4>>({
      .name = name,
      .title = "The device's own sampler of " + format_name +
               " against all answers that the specification allows",
      .source = "Vulkan 1.3, Image Sampling",
      .rows = {110, 111, 113, 114},
      .axes = with_sampler_axes(
          {{.name = "filter", .low = 0, .high = 5, .standard = 2, .whole = true, .each = true}}),
      .problem =
          [format](const Setting& setting, const gpu::DeviceInfo& device) {
            return for_hardware(setting, device, format);
          },
      .cpu = {{.solve = [](const Lookups& p) { return sample_all(p); }}},
      .gpu = {{.name = "hardware", .solve = sample_by_hardware}},
      .distance =
          [](const Lookups& p, const std::vector<dvec4>& got, const std::vector<dvec4>&) {
            return worst(p, got, [&](const TextureFootprint& f) {
              return cpu::allowed_levels(dvec2(f.uv_dx), dvec2(f.uv_dy), p.levels[0].width(),
                                         p.levels[0].height(), p.level_bits);
            });
          },
      .tolerance = hardware_tolerance,
      .why = "outside of the answers that the device's subTexelPrecisionBits and "
             "mipmapPrecisionBits allow: floats as in software; 8-bit formats may be filtered in "
             "8 bits, which rounds after each mix, half a code each: two in a level, one between "
             "levels, none for nearest texels of nearest levels",
  });
}

const Registration of_floats =
    fixed_function("texture/fixed_function", "floats", gpu::Format::rgba32_float);
const Registration of_bytes =
    fixed_function("texture/fixed_function_8bit", "8-bit codes", gpu::Format::rgba8);
const Registration of_srgb =
    fixed_function("texture/fixed_function_srgb", "sRGB codes", gpu::Format::rgba8_srgb);

}  // namespace
}  // namespace parity
