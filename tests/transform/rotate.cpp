#include "cpu_reference/transform/rotate.h"

#include <gtest/gtest.h>

#include <numbers>

#include "cpu_reference/transform/quaternion.h"
#include "geometry/random.h"
#include "geometry/transform.h"
#include "gpu/transform/rotate.h"
#include "tests/stage.h"
#include "tests/transform/matrices.h"

namespace parity {
namespace {

using transform_test::u;

std::vector<AxisAngle> random_rotations(const Setting& setting) {
  Random random{setting.seed};
  const float reach = float(setting.at("angle"));
  std::vector<AxisAngle> rotations(std::size_t(setting.count("count")));
  for (AxisAngle& r : rotations) r = {random.direction(), random.uniform(-reach, reach)};
  return rotations;
}

const Registration registration = register_stage<std::vector<AxisAngle>, std::vector<dmat3>>({
    .name = "transform/rotate",
    .title = "Rotation about an axis (Rodrigues)",
    .source = "notes 2.3",
    .rows = {27, 28},
    .axes = {transform_test::count_axis(),
             {.name = "angle",
              .unit = "rad",
              .low = 1e-4,
              .high = 3.14159,
              .standard = 3,
              .logarithmic = true}},
    .problem = random_rotations,
    .cpu = {{.solve =
                 [](const std::vector<AxisAngle>& rotations) { return cpu::rotate(rotations); }}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const std::vector<AxisAngle>& rotations) {
                   return transform_test::widened<dmat3>(gpu::rotate(context, rotations));
                 }}},
    .distance = transform_test::matrix_distance<dmat3>,
    .tolerance = 3 * 0x1p-11,
    .why = "Vulkan lets sin and cos be wrong by 2^-11 each on [-pi, pi]; cos enters an element "
           "twice (once through "
           "1 - cos), sin once, by factors of at most 1; rounding is far below",
    .chart_axes = {"count"},
});

TEST(Rotate, EqualsTheQuaternionMatrix) {
  Random random{7};
  for (int i = 0; i < 200; ++i) {
    const AxisAngle r{random.direction(), random.uniform(-3.14f, 3.14f)};
    const dmat3 rodrigues = cpu::rotate(std::vector<AxisAngle>{r})[0];
    const dvec3 axis = glm::normalize(dvec3(r.axis));
    const dmat3 quaternion = cpu::quaternion_matrix(cpu::quaternion_from_axis_angle(axis, r.angle));
    for (int c = 0; c < 3; ++c)
      EXPECT_LT(glm::length(rodrigues[c] - quaternion[c]), 4e-7);  // the float axis is unit to u
  }
}

TEST(Rotate, KeepsLengthsAndHandedness) {
  for (const double angle : {0.0, 1e-9, 1.0, std::numbers::pi, 6.0})
    for (const dmat3& m :
         {cpu::rotation_x(angle), cpu::rotation_y(angle), cpu::rotation_z(angle)}) {
      EXPECT_NEAR(glm::determinant(m), 1, 1e-14);
      const dmat3 product = glm::transpose(m) * m;
      for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) EXPECT_NEAR(product[c][r], c == r, 1e-14);
    }
}

TEST(Rotate, TurnsXToYAboutZ) {
  const dvec3 v = cpu::rotation_z(std::numbers::pi / 2) * dvec3(1, 0, 0);
  EXPECT_NEAR(v.y, 1, 1e-15);
  const dvec3 w = cpu::rodrigues({1, 0, 0}, {0, 0, 1}, std::numbers::pi / 2);
  EXPECT_NEAR(w.y, 1, 1e-15);
}

}  // namespace
}  // namespace parity
