#include "cpu_reference/raster/depth.h"

#include <algorithm>
#include <limits>

#include "geometry/random.h"
#include "gpu/raster/depth.h"
#include "tests/chart.h"
#include "tests/raster/triangles.h"
#include "tests/stage.h"

namespace parity {
namespace {

constexpr float near_plane = 0.5f;
constexpr float far_plane = 200.0f;

struct DepthProblem {
  raster_test::RasterProblem raster;
  DepthMode mode = DepthMode::standard;
};
auto fields_of(const DepthProblem*) {
  return std::tuple{&DepthProblem::raster, &DepthProblem::mode};
}

/// Random triangles whose corners stand at distances of 1 to 100 m, in the convention of the mode.
DepthProblem random_depths(const Setting& setting, const gpu::DeviceInfo& device) {
  DepthProblem p;
  p.mode = DepthMode(setting.count("mode"));
  TriangleList list = raster_test::make_triangles(raster_test::Kind::random, setting.count("side"),
                                                  1, setting.count("triangles"), setting.seed);
  Random random{setting.seed, 2};
  for (vec4& c : list.clip_positions) {
    const float distance = std::exp2(random.uniform(0.0f, 6.6f));
    const float depth = p.mode == DepthMode::logarithmic
                            ? 0.5f
                            : float(cpu::depth_value(p.mode, near_plane, far_plane, distance));
    c = vec4(c.x, c.y, 0, c.w) * (distance / c.w);
    c.z = depth * distance;
  }
  p.raster = raster_test::for_device(std::move(list), device);
  return p;
}

/// Depth in units of the bound of what each pixel shows. Where a device shows b instead of a, its
/// depth of b is before its own of a, and that of the reference behind: it differs by no more than
/// the greater of both bounds.
double distance(const DepthProblem& p, const DepthImage& got, const DepthImage& want) {
  for (const std::uint32_t front : got.front)
    if (front > p.raster.list.triangles.size()) return std::numeric_limits<double>::infinity();
  const auto bound_of = [&](const Grid<std::uint32_t>& front) {
    return cpu::depth_bound(p.raster.list, front, p.mode, {near_plane, far_plane},
                            p.raster.snapping);
  };
  const Grid<double> bound = bound_of(want.front), other_bound = bound_of(got.front);
  double worst = 0;
  for (std::size_t i = 0; i < want.front.size(); ++i) {
    const bool covered = want.front.values()[i] != 0;
    if (covered != (got.front.values()[i] != 0)) return std::numeric_limits<double>::infinity();
    const double apart = std::abs(double(got.depth.values()[i]) - double(want.depth.values()[i]));
    if (apart == 0) continue;
    const double allowed = std::max(bound.values()[i], other_bound.values()[i]);
    worst = std::max(worst, covered ? apart / allowed : std::numeric_limits<double>::infinity());
  }
  return worst;
}

const Registration registration = register_stage<DepthProblem, DepthImage>({
    .name = "raster/depth",
    .title = "What is in front, by a depth buffer: standard, reverse-Z, logarithmic",
    .source = "notes 1.7; Reed 2015; Vulkan 1.3, Depth Test",
    .rows = {5, 13, 14},
    .axes = {{.name = "mode", .low = 0, .high = 2, .standard = 1, .whole = true, .each = true},
             {.name = "triangles",
              .low = 1,
              .high = 300,
              .standard = 60,
              .logarithmic = true,
              .whole = true},
             raster_test::side_axis()},
    .problem = random_depths,
    .cpu = {{.solve =
                 [](const DepthProblem& p) {
                   return cpu::depth_test(p.raster.list, p.mode, near_plane, far_plane,
                                          p.raster.snapping);
                 }}},
    .gpu = {{.name = "compute",
             .solve =
                 [](gpu::Context& context, const DepthProblem& p) {
                   return gpu::depth_test(context, p.raster.list, p.mode, near_plane, far_plane,
                                          p.raster.snapping);
                 }},
            {.name = "hardware",
             .solve =
                 [](gpu::Context& context, const DepthProblem& p) {
                   return gpu::hardware_depth_test(context, p.raster.list, p.mode, near_plane,
                                                   far_plane);
                 }}},
    .distance = distance,
    .tolerance = 1.0,
    .why = "in units of each pixel's bound: that of interpolation for the affine z / w; for "
           "logarithmic depth that of w and of log2; of two triangles that change places the "
           "greater one",
    .chart_axes = {"side"},
});

}  // namespace
}  // namespace parity
