#include "cpu_reference/raster/edge_coverage.h"

#include <gtest/gtest.h>

#include "cpu_reference/raster/rasterize.h"
#include "gpu/raster/edge_coverage.h"
#include "tests/raster/coverage_rule.h"
#include "tests/stage.h"

namespace parity {
namespace {

using raster_test::RasterProblem;

bool device_samples(const gpu::Context& context, int samples) {
  const std::vector<int>& counts = context.info().sample_counts;
  return std::find(counts.begin(), counts.end(), samples) != counts.end();
}

const Registration registration = register_stage<RasterProblem, Coverage>({
    .name = "raster/edge_coverage",
    .title = "Which samples a triangle covers, by integer edge functions with the top-left rule",
    .source = "notes 1.2, 1.4, 1.5; Pineda 1988; Vulkan 1.3, Basic Polygon Rasterization",
    .rows = {2, 6, 7, 8, 9, 10, 19},
    .axes = {raster_test::kind_axis(raster_test::Kind::huge), raster_test::samples_axis(),
             raster_test::side_axis()},
    .problem = raster_test::make_raster_problem,
    .cpu =
        {{.name = "incremental",
          .solve = [](const RasterProblem& p) { return cpu::edge_coverage(p.list, p.snapping); }},
         {.name = "direct",
          .solve =
              [](const RasterProblem& p) { return cpu::edge_coverage_direct(p.list, p.snapping); },
          .must_agree = true},
         {.name = "spans",
          .solve = [](const RasterProblem& p) { return cpu::span_coverage(p.list, p.snapping); },
          .must_agree = true}},
    .gpu = {{.name = "compute",
             .solve =
                 [](gpu::Context& context, const RasterProblem& p) {
                   return gpu::edge_coverage(context, p.list, p.snapping);
                 }},
            {.name = "hardware",
             .solve = [](gpu::Context& context, const RasterProblem& p) -> Measured<Coverage> {
               if (!device_samples(context, p.list.samples))
                 throw Unsupported("the device has no " + std::to_string(p.list.samples) +
                                   " samples a pixel");
               return gpu::hardware_coverage(context, p.list);
             }}},
    .distance = raster_test::wrong_samples,
    .tolerance = 0.0,
    .why =
        "samples that differ: after snapping everything is integers; samples within sqrt2 2^-(b+1) "
        "px of a side of a triangle that a device may clip do not count, and none within sqrt2 "
        "2^-b px of an edge on a device whose snapping is unknown",
    .chart_axes = {"side"},
});

}  // namespace
}  // namespace parity
