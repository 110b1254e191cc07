#include "cpu_reference/transform/compose.h"

#include <gtest/gtest.h>

#include "geometry/random.h"
#include "geometry/transform.h"
#include "gpu/transform/compose.h"
#include "tests/stage.h"
#include "tests/transform/matrices.h"

namespace parity {
namespace {

using transform_test::u;

std::vector<Trs> random_poses(const Setting& setting) {
  Random random{setting.seed};
  const float scale = float(setting.at("scale"));
  std::vector<Trs> poses(std::size_t(setting.count("count")));
  for (Trs& pose : poses)
    pose = {random.in_box(100.0f), random.rotation(),
            vec3(scale) * (vec3(1.5f) + random.in_box(1.0f))};
  return poses;
}

const Registration registration = register_stage<std::vector<Trs>, std::vector<dmat4>>({
    .name = "transform/compose",
    .title = "Translation after rotation after scale, as one matrix",
    .source = "notes 2.1-2.4",
    .rows = {25, 26, 27, 30},
    .axes = {transform_test::count_axis(),
             {.name = "scale", .low = 1e-3, .high = 1e3, .standard = 1, .logarithmic = true}},
    .problem = random_poses,
    .cpu = {{.solve = [](const std::vector<Trs>& poses) { return cpu::compose(poses); }}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const std::vector<Trs>& poses) {
                   return transform_test::widened<dmat4>(gpu::compose(context, poses));
                 }}},
    .distance = transform_test::matrix_distance<dmat4>,
    .tolerance = 14 * u,
    .why =
        "an element is 1 - 2(y^2 + z^2) or 2(xy - zw), times a scale: 6 roundings of terms up to 2 "
        "(12 u), one for the scale; the quaternion's own norm is off by u and both sides read the "
        "same one",
    .chart_axes = {"count"},
});

TEST(Compose, ScalesThenTurnsThenMoves) {
  const float half = std::sqrt(0.5f);
  const Trs pose{{10, 0, 0}, quat(half, 0, 0, half), {2, 3, 1}};  // a quarter turn about z
  const dvec4 p = cpu::compose(std::vector<Trs>{pose})[0] * dvec4(1, 1, 0, 1);
  EXPECT_NEAR(p.x, 10 - 3, 1e-6);
  EXPECT_NEAR(p.y, 2, 1e-6);
}

TEST(Compose, AnotherOrderGivesAnotherPlace) {
  const dmat4 move = cpu::translation({1, 0, 0});
  const dmat4 stretch = cpu::scaling({2, 2, 2});
  EXPECT_EQ((move * stretch * dvec4(0, 0, 0, 1)).x, 1);
  EXPECT_EQ((stretch * move * dvec4(0, 0, 0, 1)).x, 2);
}

}  // namespace
}  // namespace parity
