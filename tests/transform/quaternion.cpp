#include "cpu_reference/transform/quaternion.h"

#include <gtest/gtest.h>

#include "geometry/random.h"
#include "geometry/transform.h"
#include "gpu/transform/quaternion.h"
#include "tests/stage.h"
#include "tests/transform/matrices.h"

namespace parity {
namespace {

using transform_test::u;

std::vector<quat> random_quaternions(const Setting& setting) {
  Random random{setting.seed};
  std::vector<quat> quaternions(std::size_t(setting.count("count")));
  for (quat& q : quaternions) q = random.rotation();
  return quaternions;
}

const Axis count_axis{
    .name = "count", .low = 1, .high = 4099, .standard = 131, .logarithmic = true, .whole = true};

const Registration matrix = register_stage<std::vector<quat>, std::vector<dmat3>>({
    .name = "transform/quaternion_matrix",
    .title = "Rotation matrix of a unit quaternion",
    .source = "notes 2.7",
    .rows = {38},
    .axes = {count_axis},
    .problem = random_quaternions,
    .cpu = {{.solve = [](const std::vector<quat>& q) { return cpu::quaternion_matrix(q); }}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const std::vector<quat>& q) {
                   return transform_test::widened<dmat3>(gpu::quaternion_matrix(context, q));
                 }}},
    .distance = transform_test::matrix_distance<dmat3>,
    .tolerance = 12 * u,
    .why = "1 - 2(y^2 + z^2) and 2(xy - zw): at most 6 roundings of terms up to 2; forms that "
           "differ by the "
           "quaternion's norm, which is 1 to 2 u, are further apart by 4 u at most",
    .chart_axes = {"count"},
});

struct Turns {
  std::vector<quat> quaternions;
  std::vector<vec3> vectors;
};
auto fields_of(const Turns*) { return std::tuple{&Turns::quaternions, &Turns::vectors}; }

const Registration rotate = register_stage<Turns, std::vector<dvec3>>({
    .name = "transform/quaternion_rotate",
    .title = "q v q^-1",
    .source = "notes 2.7",
    .rows = {38},
    .axes = {count_axis},
    .problem =
        [](const Setting& setting) {
          Random random{setting.seed};
          Turns turns;
          for (int i = 0; i < setting.count("count"); ++i) {
            turns.quaternions.push_back(random.rotation());
            turns.vectors.push_back(random.in_box(1.0f));
          }
          return turns;
        },
    .cpu = {{.solve =
                 [](const Turns& t) { return cpu::quaternion_rotate(t.quaternions, t.vectors); }}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const Turns& t) {
                   return transform_test::widened<dvec3>(
                       gpu::quaternion_rotate(context, t.quaternions, t.vectors));
                 }}},
    .distance =
        [](const std::vector<dvec3>& got, const std::vector<dvec3>& want) {
          double worst = 0;
          for (std::size_t i = 0; i < want.size(); ++i)
            worst = std::max(worst, glm::length(got[i] - want[i]));
          return worst;
        },
    .tolerance = std::sqrt(3.0) * 24 * u,
    .why = "v + 2 w (q x v) + 2 q x (q x v) with |v| <= sqrt 3: two cross products (3 roundings "
           "each, terms up to "
           "2 |v|), two products, two sums; the inverse of a quaternion whose norm is 1 to 2 u "
           "adds 4 u; times |v|",
    .chart_axes = {"count"},
});

TEST(Quaternion, ComposesFromTheRight) {
  Random random{3};
  for (int i = 0; i < 100; ++i) {
    const dquat first = cpu::quaternion_normalize(dquat(random.rotation()));
    const dquat second = cpu::quaternion_normalize(dquat(random.rotation()));
    const dvec3 v{random.in_box(1.0f)};
    const dvec3 together = cpu::quaternion_rotate(cpu::quaternion_compose(second, first), v);
    const dvec3 apart = cpu::quaternion_rotate(second, cpu::quaternion_rotate(first, v));
    EXPECT_LT(glm::length(together - apart), 1e-14);
    EXPECT_NEAR(glm::length(together), glm::length(v), 1e-14);
  }
}

TEST(Quaternion, InverseUndoesEvenIfNotUnit) {
  const dquat q(0.5, 1.0, -2.0, 0.25);
  const dvec3 v{1, 2, 3};
  const dvec3 back =
      cpu::quaternion_rotate(cpu::quaternion_inverse(q), cpu::quaternion_rotate(q, v));
  EXPECT_LT(glm::length(back - v), 1e-13);
}

}  // namespace
}  // namespace parity
