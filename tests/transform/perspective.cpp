#include "cpu_reference/transform/perspective.h"

#include <gtest/gtest.h>

#include <limits>

#include "geometry/random.h"
#include "gpu/transform/perspective.h"
#include "tests/stage.h"
#include "tests/transform/matrices.h"
#include "tests/transform/projections.h"

namespace parity {
namespace {

using transform_test::Projections;
using transform_test::u;

/// Off-centre frusta with far / near = ratio.
Projections frusta(const Setting& setting) {
  Random random{setting.seed};
  Projections problem = transform_test::no_projections(setting);
  for (int i = 0; i < setting.count("count"); ++i) {
    ViewVolume v;
    v.near = random.uniform(0.01f, 2.0f);
    v.far = v.near * float(setting.at("ratio")) * random.uniform(1.0f, 2.0f);
    v.right = v.near * random.uniform(0.2f, 2.0f);
    v.left = -v.near * random.uniform(0.2f, 2.0f);
    v.top = v.near * random.uniform(0.2f, 2.0f);
    v.bottom = -v.near * random.uniform(0.2f, 2.0f);
    if (i % 7 == 0) v.far = std::numeric_limits<float>::infinity();
    problem.volumes.push_back(v);
  }
  return problem;
}

const Registration registration = register_stage<Projections, std::vector<dmat4>>({
    .name = "transform/perspective",
    .title = "Clip from view for a frustum, Vulkan's depth 0 to 1, y down",
    .source = "notes 2.6; Vulkan 1.3, Coordinate Transformations",
    .rows = {32, 33, 35, 36, 37},
    .axes = {transform_test::count_axis(),
             {.name = "ratio", .low = 1.5, .high = 1e6, .standard = 100, .logarithmic = true},
             transform_test::reverse_axis()},
    .problem = frusta,
    .cpu = {{.solve = [](const Projections& p) { return cpu::perspective(p.volumes, p.depth); }}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const Projections& p) {
                   return transform_test::widened<dmat4>(
                       gpu::perspective(context, p.volumes, p.depth));
                 }}},
    .distance = transform_test::matrix_distance<dmat4>,
    .tolerance = 16 * u,
    .why = "each element is a quotient of sums, differences and products of inputs of like sign "
           "(near, -far; "
           "left < 0 < right), so nothing cancels but r + l, which is at most r - l: 3 roundings "
           "and a division "
           "of 2.5 ULP (5 u), relative to elements up to the largest; far - near with far >= 1.5 "
           "near loses a "
           "factor (f + n) / (f - n) <= 5 of one rounding at the axis's low end",
    .chart_axes = {"count"},
});

dvec3 project(const dmat4& clip, const dvec3& p) {
  const dvec4 c = clip * dvec4(p, 1.0);
  return dvec3(c) / c.w;
}

TEST(Perspective, MapsTheFrustumToTheVulkanBox) {
  const ViewVolume v{-1, 2, -0.5, 1.5, 1, 10};
  const dmat4 clip = cpu::perspective(std::vector<ViewVolume>{v}, DepthMode::standard)[0];
  const dvec3 near = project(clip, {v.left, v.top, -1});
  EXPECT_NEAR(near.x, -1, 1e-14);
  EXPECT_NEAR(near.y, -1, 1e-14);  // the top is row 0
  EXPECT_NEAR(near.z, 0, 1e-14);
  const dvec3 far = project(clip, {10 * v.right, 10 * v.bottom, -10});
  EXPECT_NEAR(far.x, 1, 1e-14);
  EXPECT_NEAR(far.y, 1, 1e-14);
  EXPECT_NEAR(far.z, 1, 1e-14);
}

TEST(Perspective, OpenGlHasDepthFromMinusOne) {
  const dmat4 clip = cpu::perspective_gl({-1, 1, -1, 1, 1, 10});
  EXPECT_NEAR(project(clip, {0, 0, -1}).z, -1, 1e-14);
  EXPECT_NEAR(project(clip, {0, 0, -10}).z, 1, 1e-14);
}

TEST(Perspective, FocalLengthFitsTheFieldOfView) {
  EXPECT_NEAR(cpu::focal_length(2.0, std::acos(0.0)), 1.0, 1e-15);  // 90 degrees: half the height
}

}  // namespace
}  // namespace parity
