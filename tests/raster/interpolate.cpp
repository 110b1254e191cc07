#include "cpu_reference/raster/interpolate.h"

#include <limits>

#include "geometry/random.h"
#include "gpu/raster/interpolate.h"
#include "tests/raster/triangles.h"
#include "tests/stage.h"

namespace parity {
namespace {

using raster_test::Kind;

struct InterpolationProblem {
  raster_test::RasterProblem raster;
  Varyings varyings;
};
auto fields_of(const InterpolationProblem*) {
  return std::tuple{&InterpolationProblem::raster, &InterpolationProblem::varyings};
}

InterpolationProblem random_varyings(const Setting& setting, const gpu::DeviceInfo& device) {
  const auto kind = Kind(setting.count("kind"));
  const int count = kind == Kind::random || kind == Kind::ties ? 40 : 400;
  InterpolationProblem p;
  p.raster = raster_test::for_device(
      raster_test::make_triangles(kind, setting.count("side"), 1, count, setting.seed), device);
  Random random{setting.seed, 1};
  for (std::size_t i = 0; i < p.raster.list.clip_positions.size(); ++i)
    p.varyings.values.push_back(vec4(random.in_box(1.0f), 1.0f + random.uniform()));
  p.varyings.perspective = setting.count("perspective") != 0;
  return p;
}

/// Worst difference in units of each pixel's own bound.
double distance(const InterpolationProblem& p, const Grid<dvec4>& got, const Grid<dvec4>& want) {
  const Grid<double> bound = cpu::interpolate_bound(p.raster.list, p.varyings, p.raster.snapping);
  double worst = 0;
  for (std::size_t i = 0; i < want.size(); ++i) {
    const dvec4 apart = glm::abs(got.values()[i] - want.values()[i]);
    const double largest = std::max({apart.x, apart.y, apart.z, apart.w});
    if (largest > 0) worst = std::max(worst, largest / bound.values()[i]);
  }
  return worst;
}

/// The device leaves 0 where nothing is, the reference NaN; w is at least 1 where something is.
Grid<dvec4> widened(const Grid<vec4>& values) {
  Grid<dvec4> result{values.width(), values.height(),
                     dvec4(std::numeric_limits<double>::quiet_NaN())};
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values.values()[i].w != 0) result.values()[i] = dvec4(values.values()[i]);
  return result;
}

const Registration registration = register_stage<InterpolationProblem, Grid<dvec4>>({
    .name = "raster/interpolate",
    .title = "What a vertex says, at a pixel: perspective-correct or affine in the window",
    .source = "notes 1.3, 1.6; Vulkan 1.3, Basic Polygon Rasterization",
    .rows = {4, 12},
    .axes = {raster_test::kind_axis(Kind::behind),
             raster_test::side_axis(),
             {.name = "perspective", .low = 0, .high = 1, .standard = 1, .whole = true}},
    .problem = random_varyings,
    .cpu = {{.solve =
                 [](const InterpolationProblem& p) {
                   return cpu::interpolate(p.raster.list, p.varyings, p.raster.snapping);
                 }}},
    .gpu = {{.name = "compute",
             .solve =
                 [](gpu::Context& context, const InterpolationProblem& p) {
                   return widened(
                       gpu::interpolate(context, p.raster.list, p.varyings, p.raster.snapping));
                 }},
            {.name = "hardware",
             .solve =
                 [](gpu::Context& context, const InterpolationProblem& p) {
                   return widened(gpu::hardware_interpolate(context, p.raster.list, p.varyings));
                 }}},
    .distance = distance,
    .tolerance = 1.0,
    .why = "in units of each pixel's own bound: a vertex may move by half a step of the sub-pixel "
           "grid, which "
           "changes an affine function by sqrt2 2^-(b+1) |gradient|; float evaluation of its plane "
           "adds "
           "8 2^-24 (|a0| + |a_x| W + |a_y| H); the perspective quotient takes both",
    .chart_axes = {"side"},
});

}  // namespace
}  // namespace parity
