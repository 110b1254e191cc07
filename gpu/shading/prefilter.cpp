#include "gpu/shading/prefilter.h"

#include <stdexcept>
#include <string>
#include <vector>

#include "gpu/core/buffer.h"
#include "gpu/core/commands.h"
#include "gpu/core/kernel.h"
#include "shaders.h"
#include "shaders/shading/layout.h"

namespace parity::gpu {
namespace {

/// Sixteen texels of a level are enough for polynomials of degree 2; this is four times as fine.
constexpr int harmonics_side = 64;

struct Source {
  std::vector<vec4> texels;
  std::vector<std::uint32_t> begins;
};

Source bordered_levels(const EnvironmentMap& map) {
  Source source;
  for (const Grid<vec4>& level : map.levels) {
    source.begins.push_back(std::uint32_t(source.texels.size()));
    const Grid<vec4> bordered = with_border(level);
    source.texels.insert(source.texels.end(), bordered.begin(), bordered.end());
  }
  return source;
}

/// The finest level of at most that side.
std::size_t level_of_side(const EnvironmentMap& map, int side) {
  std::size_t level = 0;
  while (map.levels[level].width() > side) ++level;
  return level;
}

/// A map on the device.
struct Uploaded {
  Uploaded(Context& context, const EnvironmentMap& map)
      : source(bordered_levels(map)),
        texels(context, source.texels),
        begins(context, source.begins),
        side(std::uint32_t(map.levels[0].width())) {}
  Source source;
  Buffer<vec4> texels;
  Buffer<std::uint32_t> begins;
  std::uint32_t side;
};

Grid<vec4> mirror(Context& context, const Uploaded& map, double roughness, int side, int samples) {
  const Kernel<MirrorArgs> kernel(context, shaders::shading_prefilter_mirror_comp);
  Grid<vec4> result{side, side};
  const Buffer<vec4> texels(context, result.size());
  const MirrorArgs args{.source = map.texels,
                        .begins = map.begins,
                        .mirror = texels,
                        .source_side = map.side,
                        .level_count = std::uint32_t(map.source.begins.size()),
                        .side = std::uint32_t(side),
                        .samples = std::uint32_t(samples),
                        .roughness = float(roughness),
                        .padding = 0};
  context.run([&](Commands& commands) { commands.dispatch(kernel, {args.side, args.side}, args); });
  result.values() = texels.read();
  return result;
}

std::array<vec3, 9> harmonics(Context& context, const Uploaded& map, const EnvironmentMap& levels) {
  const std::size_t level = level_of_side(levels, harmonics_side);
  const auto side = std::uint32_t(levels.levels[level].width());
  const Buffer<vec4> rows(context, std::size_t(side) * 9), sums(context, 9);
  const Kernel<HarmonicsArgs> by_row(context, shaders::shading_harmonics_rows_comp);
  const Kernel<HarmonicsArgs> of_rows(context, shaders::shading_harmonics_sum_comp);
  const HarmonicsArgs args{map.texels.ref(map.source.begins[level]), rows, sums, side, 0};
  context.run([&](Commands& commands) {
    commands.dispatch(by_row, {side}, args);
    commands.dispatch(of_rows, {9}, args);
  });
  std::array<vec3, 9> result;
  const std::vector<vec4> values = sums.read();
  for (std::size_t k = 0; k < 9; ++k) result[k] = vec3(values[k]);
  return result;
}

Grid<vec4> irradiance(Context& context, const Uploaded& map, const EnvironmentMap& levels) {
  const std::size_t level = level_of_side(levels, irradiance_source_side);
  const Kernel<IrradianceArgs> kernel(context, shaders::shading_irradiance_comp);
  Grid<vec4> result{irradiance_side, irradiance_side};
  const Buffer<vec4> texels(context, result.size());
  const IrradianceArgs args{.level = map.texels.ref(map.source.begins[level]),
                            .irradiance = texels,
                            .level_side = std::uint32_t(levels.levels[level].width()),
                            .side = irradiance_side};
  context.run([&](Commands& commands) { commands.dispatch(kernel, {args.side, args.side}, args); });
  result.values() = texels.read();
  return result;
}

void check(const EnvironmentMap& map, int samples) {
  if (samples < 1 || samples > 4096)
    throw std::invalid_argument("gpu::prefilter: samples is " + std::to_string(samples) +
                                ", must be 1 to 4096");
  if (map.levels.size() < 2)
    throw std::invalid_argument("gpu::prefilter: the map has " + std::to_string(map.levels.size()) +
                                " levels, must have 2 or more");
}

}  // namespace

Grid<vec4> prefilter_mirror(Context& context, const EnvironmentMap& map, double roughness, int side,
                            int samples) {
  check(map, samples);
  return mirror(context, Uploaded(context, map), roughness, side, samples);
}

EnvironmentLight prefilter(Context& context, const EnvironmentMap& map, int samples) {
  check(map, samples);
  const Uploaded uploaded(context, map);
  EnvironmentLight light;
  light.harmonics = harmonics(context, uploaded, map);
  const Grid<vec4> by_normal = irradiance(context, uploaded, map);
  if (!harmonics_suffice(light.harmonics, by_normal)) light.irradiance = with_border(by_normal);
  for (std::size_t i = 0; i < mirror_sides.size(); ++i) {
    light.mirrors.push_back(
        with_border(mirror(context, uploaded, mirror_roughness[i], mirror_sides[i], samples)));
  }
  return light;
}

Grid<vec4> prefilter_irradiance(Context& context, const EnvironmentMap& map) {
  check(map, 1);
  return irradiance(context, Uploaded(context, map), map);
}

std::array<vec3, 9> project_irradiance(Context& context, const EnvironmentMap& map) {
  check(map, 1);
  return harmonics(context, Uploaded(context, map), map);
}

}  // namespace parity::gpu
