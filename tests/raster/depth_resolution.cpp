#include <cmath>

#include "cpu_reference/raster/depth.h"
#include "geometry/raster.h"
#include "gpu/raster/depth.h"
#include "tests/chart.h"

/// How fine depth is, and where it is too coarse.
namespace parity {
namespace {

constexpr double near_plane = 0.1;
constexpr double far_plane = 1e5;

std::string name_of(DepthMode mode) {
  return mode == DepthMode::standard    ? "standard"
         : mode == DepthMode::reverse_z ? "reverse-Z"
                                        : "logarithmic";
}

ChartData resolution(gpu::Context&) {
  ChartData data;
  for (const DepthMode mode : {DepthMode::standard, DepthMode::reverse_z, DepthMode::logarithmic}) {
    Series measured{name_of(mode), {}};
    Series theory{name_of(mode) + ", closed form", {}, Series::Kind::theory};
    for (int i = 0; i <= 60; ++i) {
      const double distance = near_plane * 1.01 * std::pow(far_plane / near_plane * 0.98, i / 60.0);
      measured.points.push_back(
          {distance, cpu::depth_step_measured(mode, near_plane, far_plane, distance)});
      theory.points.push_back({distance, cpu::depth_step(mode, near_plane, far_plane, distance)});
    }
    data.series.push_back(measured);
    data.series.push_back(theory);
  }
  data.assertions.push_back({"reverse-Z step over standard step at 1 km",
                             cpu::depth_step(DepthMode::reverse_z, near_plane, far_plane, 1000) /
                                 cpu::depth_step(DepthMode::standard, near_plane, far_plane, 1000),
                             1e-2});
  data.settings = {{"near", "0.1 m"}, {"far", "100 km"}, {"buffer", "D32F"}};
  return data;
}

const Registration chart = register_chart({
    .name = "raster/depth_resolution",
    .title = "Smallest step of a 32-bit float depth buffer",
    .x = {.label = "distance", .unit = "m"},
    .y = {.label = "step", .unit = "m"},
    .produce = resolution,
});

constexpr int side = 64;
constexpr double relative_gap = 1e-3;

/// Two parallel quads that lean away from the viewer, the farther one behind by the gap; drawn
/// first, so that a tie shows it. Fraction of pixels that show it.
double fraction_fighting(gpu::Context& context, DepthMode mode, double distance, double near) {
  TriangleList list{.width = side, .height = side, .samples = 1};
  for (const double d : {distance * (1 + relative_gap), distance}) {
    const auto first = std::uint32_t(list.clip_positions.size());
    for (const dvec2 corner : {dvec2(-1, -1), dvec2(1, -1), dvec2(1, 1), dvec2(-1, 1)}) {
      const double w = d * (1 + 0.2 * corner.y);
      const double z = cpu::depth_value(mode, near, far_plane, w) * w;
      list.clip_positions.push_back(vec4(dvec4(0.9 * corner * w, z, w)));
    }
    list.triangles.push_back({first, first + 1, first + 2});
    list.triangles.push_back({first, first + 2, first + 3});
  }
  const DepthImage image =
      gpu::hardware_depth_test(context, list, mode, float(near), float(far_plane));
  double wrong = 0;
  double covered = 0;
  for (const std::uint32_t front : image.front) {
    covered += front != 0;
    wrong += front == 1 || front == 2;
  }
  return wrong / covered;
}

/// The near plane below which the gap is smaller than a step of the buffer: for the standard mode
/// depth ~ 1 - n / z, whose codes near 1 are 2^-24 apart, and d depth = n / z^2 dz.
double near_of_one_step(double distance) { return 0x1p-24 * distance / relative_gap; }

Map fighting_map(DepthMode mode) {
  Map map{
      .name =
          "raster/z_fighting_" + std::string(mode == DepthMode::standard ? "standard" : "reverse"),
      .title = "Pixels that show the farther of two surfaces 0.1 % of the distance apart, depth " +
               name_of(mode),
      .x = {.name = "distance",
            .unit = "m",
            .low = 2,
            .high = 5e4,
            .standard = 100,
            .logarithmic = true},
      .y = {.name = "near plane",
            .unit = "m",
            .low = 1e-6,
            .high = 1,
            .standard = 0.1,
            .logarithmic = true},
      .value_label = "wrong pixels",
      .logarithmic = false,
      .border = 0.01,
      .columns = 16,
      .rows = 12,
      .value = [mode](gpu::Context& context, double distance,
                      double near) { return fraction_fighting(context, mode, distance, near); },
  };
  if (mode == DepthMode::standard)
    map.theory.push_back({"gap = one step of the buffer", near_of_one_step});
  return map;
}

const Registration standard_map = register_map(fighting_map(DepthMode::standard));
const Registration reverse_map = register_map(fighting_map(DepthMode::reverse_z));

}  // namespace
}  // namespace parity
