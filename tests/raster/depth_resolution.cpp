#include <algorithm>
#include <cmath>

#include "cpu_reference/raster/depth.h"
#include "geometry/random.h"
#include "geometry/raster.h"
#include "gpu/raster/depth.h"
#include "tests/chart.h"

/// How fine depth is, and where it is too coarse.
namespace parity {
namespace {

constexpr double near_plane = 0.1;
constexpr double far_plane = 1e5;

/// A way to store depth between two planes, m.
struct DepthRange {
  DepthMode mode = DepthMode::standard;
  double near = near_plane;
  double far = far_plane;
};

std::string name_of(DepthMode mode) {
  return mode == DepthMode::standard    ? "standard"
         : mode == DepthMode::reverse_z ? "reverse"
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

constexpr int tiles = 16;        ///< of the picture, in each direction
constexpr int tile_side = 8;     ///< pixels
constexpr double jitter = 0.06;  ///< of a tile's distance, relative

/// Adds a quad that fills a tile and leans away from the viewer. Depth is made in double and
/// rounded with w, as a vertex stage that is as good as it can be hands it on.
void add_quad(TriangleList& list, ivec2 tile, double distance, const DepthRange& range) {
  const auto first = std::uint32_t(list.clip_positions.size());
  for (const ivec2 corner : {ivec2(0, 0), ivec2(1, 0), ivec2(1, 1), ivec2(0, 1)}) {
    const double w = distance * (1 + 0.02 * corner.y);
    const double z = cpu::depth_value(range.mode, range.near, range.far, w) * w;
    const dvec2 ndc = dvec2(tile + corner) * (2.0 / tiles) - 1.0;
    list.clip_positions.push_back(vec4(dvec4(ndc * w, z, w)));
  }
  list.triangles.push_back({first, first + 1, first + 2});
  list.triangles.push_back({first, first + 2, first + 3});
}

/// Fraction of pixels that do not show the nearer of two parallel quads a relative gap apart, the
/// farther one drawn first, so that a tie shows it; or neither, where rounding puts both behind the
/// far plane. A quad a tile, at distances around the given one: many roundings of corners, not one.
double fraction_fighting(gpu::Context& context, const DepthRange& range, double distance,
                         double gap) {
  TriangleList list{.width = tiles * tile_side, .height = tiles * tile_side, .samples = 1};
  for (const double behind : {gap, 0.0}) {
    Random random{5};
    for (int y = 0; y < tiles; ++y)
      for (int x = 0; x < tiles; ++x)
        add_quad(list, {x, y}, distance * (1 + behind) * (1 + random.uniform(-jitter, jitter)),
                 range);
  }
  const DepthImage image =
      gpu::hardware_depth_test(context, list, range.mode, float(range.near), float(range.far));
  const auto farther = std::uint32_t(list.triangles.size() / 2);
  const auto wrong = std::count_if(image.front.begin(), image.front.end(),
                                   [&](std::uint32_t front) { return front <= farther; });
  return double(wrong) / double(image.front.size());
}

/// Up to eleven steps of the buffer, 2^-24, are lost before it: z, w, 1 / w and their product round
/// by a step each, the plane's three operations by half of one, on both surfaces.
constexpr double roundings = 11;
constexpr double largest_gap = 1e-3;

/// The near plane over the far one at which a gap is so many steps of a standard buffer: depth is
/// about 1 - n / z, its codes near 1 are 2^-24 apart, and d depth = n / z^2 dz.
TheoryLine ratio_of_steps(const std::string& label, double steps) {
  return {label, [steps](double distance) {
            return steps * 0x1p-24 * distance / largest_gap / far_plane;
          }};
}

Axis distance_axis() {
  return {
      .name = "distance", .unit = "m", .low = 2, .high = 5e4, .standard = 100, .logarithmic = true};
}

/// Over the ratio of the planes.
Map ratio_map(DepthMode mode) {
  Map map{
      .name = "raster/z_fighting_" + name_of(mode),
      .title =
          "Two surfaces 0.1 % of the distance apart, far plane at 100 km, depth " + name_of(mode),
      .x = distance_axis(),
      .y =
          {.name = "near / far", .low = 1e-11, .high = 1e-5, .standard = 1e-6, .logarithmic = true},
      .value_label = "pixels that do not show the nearer",
      .logarithmic = false,
      .border = 0.01,
      .columns = 22,
      .rows = 18,
      .value =
          [mode](gpu::Context& context, double distance, double ratio) {
            return fraction_fighting(context, {mode, ratio * far_plane, far_plane}, distance,
                                     largest_gap);
          },
  };
  if (mode == DepthMode::standard)
    map.theory = {ratio_of_steps("gap = 1 step of the buffer", 1),
                  ratio_of_steps("gap = all roundings, 11 steps", roundings)};
  return map;
}

/// Over the gap.
Map gap_map(DepthMode mode) {
  const auto steps = [mode](double count) {
    return [mode, count](double distance) {
      return count * cpu::depth_step(mode, near_plane, far_plane, distance) / distance;
    };
  };
  return {
      .name = "raster/z_fighting_gap_" + name_of(mode),
      .title = "Two surfaces a gap apart, planes at 0.1 m and 100 km, depth " + name_of(mode),
      .x = distance_axis(),
      .y =
          {.name = "gap / distance", .low = 1e-8, .high = 1, .standard = 1e-3, .logarithmic = true},
      .value_label = "pixels that do not show the nearer",
      .logarithmic = false,
      .border = 0.01,
      .columns = 22,
      .rows = 18,
      .value =
          [mode](gpu::Context& context, double distance, double gap) {
            return fraction_fighting(context, {mode, near_plane, far_plane}, distance, gap);
          },
      .theory = {{"gap = 1 step of the buffer", steps(1)},
                 {"gap = all roundings, 11 steps", steps(roundings)}},
  };
}

const Registration ratio_maps[] = {register_map(ratio_map(DepthMode::standard)),
                                   register_map(ratio_map(DepthMode::reverse_z))};
const Registration gap_maps[] = {register_map(gap_map(DepthMode::standard)),
                                 register_map(gap_map(DepthMode::reverse_z)),
                                 register_map(gap_map(DepthMode::logarithmic))};

}  // namespace
}  // namespace parity
