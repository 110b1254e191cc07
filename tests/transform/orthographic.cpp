#include "cpu_reference/transform/orthographic.h"

#include <gtest/gtest.h>

#include <limits>

#include "geometry/random.h"
#include "gpu/transform/orthographic.h"
#include "tests/stage.h"
#include "tests/transform/matrices.h"
#include "tests/transform/projections.h"

namespace parity {
namespace {

using transform_test::Projections;
using transform_test::u;

/// Boxes whose middle is `offset` half sizes away from the axis.
Projections boxes(const Setting& setting) {
  Random random{setting.seed};
  Projections problem = transform_test::no_projections(setting);
  const float offset = float(setting.at("offset"));
  for (int i = 0; i < setting.count("count"); ++i) {
    const vec3 half = vec3(1.5f) + random.in_box(1.0f);
    const vec3 middle = offset * half * random.uniform(-1.0f, 1.0f);
    const float near = random.uniform(0.0f, 3.0f);
    problem.volumes.push_back({middle.x - half.x, middle.x + half.x, middle.y - half.y,
                               middle.y + half.y, near, near + half.z});
  }
  return problem;
}

const Registration registration = register_stage<Projections, std::vector<dmat4>>({
    .name = "transform/orthographic",
    .title = "Clip from view for a box, Vulkan's depth 0 to 1, y down",
    .source = "notes 2.6; Vulkan 1.3, Coordinate Transformations",
    .rows = {34},
    .axes = {transform_test::count_axis(),
             {.name = "offset", .low = 0, .high = 10, .standard = 1},
             transform_test::reverse_axis()},
    .problem = boxes,
    .cpu = {{.solve = [](const Projections& p) { return cpu::orthographic(p.volumes, p.depth); }}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const Projections& p) {
                   return transform_test::widened<dmat4>(
                       gpu::orthographic(context, p.volumes, p.depth));
                 }}},
    .distance = transform_test::matrix_distance<dmat4>,
    .tolerance =
        [](const Projections& p) {
          double worst = 1;
          for (const ViewVolume& v : p.volumes) {
            const double reach = std::max(
                {std::abs(v.left), std::abs(v.right), std::abs(v.bottom), std::abs(v.top), v.far});
            const double size = std::min({v.right - v.left, v.top - v.bottom, v.far - v.near});
            worst = std::max(worst, reach / size);
          }
          return (8 + 4 * worst) * u;
        },
    .why = "r - l and f - n are differences of inputs: one rounding, relative to a size that may "
           "be smaller than "
           "the inputs by reach / size; a division of 2.5 ULP and two more roundings",
    .chart_axes = {"count"},
});

TEST(Orthographic, MapsTheCornersOfTheBox) {
  const ViewVolume v{-1, 3, 2, 5, 1, 9};
  for (const DepthMode depth : {DepthMode::standard, DepthMode::reverse_z}) {
    const dmat4 clip = cpu::orthographic(std::vector<ViewVolume>{v}, depth)[0];
    const dvec4 near = clip * dvec4(-1, 5, -1, 1);
    const dvec4 far = clip * dvec4(3, 2, -9, 1);
    EXPECT_NEAR(near.x, -1, 1e-15);
    EXPECT_NEAR(near.y, -1, 1e-15);
    EXPECT_NEAR(far.x, 1, 1e-15);
    EXPECT_NEAR(far.y, 1, 1e-15);
    EXPECT_NEAR(near.z, depth == DepthMode::standard ? 0 : 1, 1e-15);
    EXPECT_NEAR(far.z, depth == DepthMode::standard ? 1 : 0, 1e-15);
    EXPECT_EQ(near.w, 1);
  }
}

}  // namespace
}  // namespace parity
