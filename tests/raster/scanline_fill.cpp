#include "cpu_reference/raster/scanline_fill.h"

#include "cpu_reference/raster/edge_coverage.h"
#include "gpu/raster/scanline_fill.h"
#include "tests/raster/coverage_rule.h"
#include "tests/stage.h"

namespace parity {
namespace {

using raster_test::RasterProblem;

const Registration registration = register_stage<RasterProblem, Coverage>({
    .name = "raster/scanline_fill",
    .title = "Which samples a triangle covers, row by row between two edges",
    .source = "notes 1.5",
    .rows = {11},
    .axes = {raster_test::kind_axis(raster_test::Kind::huge), raster_test::samples_axis(),
             raster_test::side_axis()},
    .problem = raster_test::make_raster_problem,
    .cpu = {{.solve =
                 [](const RasterProblem& p) { return cpu::scanline_fill(p.list, p.snapping); }},
            {.name = "edge functions",
             .solve = [](const RasterProblem& p) { return cpu::edge_coverage(p.list, p.snapping); },
             .must_agree = true}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const RasterProblem& p) {
                   return gpu::scanline_fill(context, p.list, p.snapping);
                 }}},
    .distance = raster_test::wrong_samples,
    .tolerance = 0.0,
    .why =
        "samples that differ: integers and half-open spans on both sides; but for samples within "
        "sqrt2 2^-(b+1) px of a side of a triangle that is clipped, in float here and double there",
    .chart_axes = {"side"},
});

}  // namespace
}  // namespace parity
