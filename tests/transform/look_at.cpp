#include "cpu_reference/transform/look_at.h"

#include <gtest/gtest.h>

#include "geometry/random.h"
#include "geometry/transform.h"
#include "gpu/transform/look_at.h"
#include "tests/stage.h"
#include "tests/transform/matrices.h"

namespace parity {
namespace {

using transform_test::u;

/// Cameras whose up leans `lean` rad away from the direction of view.
std::vector<LookAt> leaning_cameras(const Setting& setting) {
  Random random{setting.seed};
  const float lean = float(setting.at("lean"));
  std::vector<LookAt> cameras(std::size_t(setting.count("count")));
  for (LookAt& camera : cameras) {
    const vec3 forward = random.direction();
    const vec3 side = glm::normalize(glm::cross(forward, random.direction()));
    camera.eye = random.in_box(2.0f);
    camera.center = camera.eye + 4.0f * forward;
    camera.up = std::cos(lean) * forward + std::sin(lean) * side;
  }
  return cameras;
}

/// The rotation is as wrong as the direction of cross(forward, up), whose length is sin(lean); the
/// last column multiplies it by the eye's distance from the origin.
double rotation_error(const std::vector<LookAt>& cameras) {
  double worst = 0;
  for (const LookAt& camera : cameras) {
    const dvec3 forward = glm::normalize(dvec3(camera.center) - dvec3(camera.eye));
    const dvec3 up = glm::normalize(dvec3(camera.up));
    worst = std::max(worst, 1 / glm::length(glm::cross(forward, up)));
  }
  return worst;
}

const Registration registration = register_stage<std::vector<LookAt>, std::vector<dmat4>>({
    .name = "transform/look_at",
    .title = "View from world for an eye, a target and an up",
    .source = "notes 2.5",
    .rows = {31},
    .axes = {transform_test::count_axis(),
             {.name = "lean", .unit = "rad", .low = 1e-2, .high = 3.13, .standard = 1}},
    .problem = leaning_cameras,
    .cpu = {{.solve = [](const std::vector<LookAt>& cameras) { return cpu::look_at(cameras); }}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const std::vector<LookAt>& cameras) {
                   return transform_test::widened<dmat4>(gpu::look_at(context, cameras));
                 }}},
    .distance =
        [](const std::vector<dmat4>& got, const std::vector<dmat4>& want) {
          double worst = 0;
          for (std::size_t k = 0; k < want.size(); ++k) {
            for (int c = 0; c < 4; ++c)
              for (int r = 0; r < 4; ++r) {
                const double reach = c < 3 ? 1 : 1 + std::sqrt(3.0) * 2;  // |eye| <= 2 sqrt 3
                worst = std::max(worst, std::abs(got[k][c][r] - want[k][c][r]) / reach);
              }
          }
          return worst;
        },
    .tolerance =
        [](const std::vector<LookAt>& cameras) { return (20 + 12 * rotation_error(cameras)) * u; },
    .why = "forward: difference and normalisation (sqrt, division at 2.5 ULP) 6 u; the cross "
           "product with up "
           "has 3 roundings a component of terms up to 1, divided by its length sin(lean): (6 + 6) "
           "u / sin(lean); "
           "its normalisation, the second cross product and the dot with the eye 14 u more",
    .chart_axes = {"count"},
    .maps = {},
});

TEST(LookAt, PutsTheEyeAtTheOriginAndTheTargetAhead) {
  const LookAt camera{{1, 2, 3}, {4, -2, 3}, {0, 0, 1}};
  const dmat4 view = cpu::look_at(std::vector<LookAt>{camera})[0];
  const dvec4 eye = view * dvec4(camera.eye, 1);
  const dvec4 target = view * dvec4(camera.center, 1);
  EXPECT_NEAR(glm::length(dvec3(eye)), 0, 1e-14);
  EXPECT_NEAR(target.z, -5, 1e-14);
  EXPECT_NEAR(target.x, 0, 1e-14);
  EXPECT_NEAR(glm::determinant(dmat3(view)), 1, 1e-14);
}

TEST(LookAt, RefusesToLookAlongUp) {
  EXPECT_THROW(cpu::look_at(std::vector<LookAt>{{{0, 0, 0}, {0, 5, 0}, {0, 1, 0}}}),
               std::invalid_argument);
  EXPECT_THROW(cpu::look_at(std::vector<LookAt>{{{1, 1, 1}, {1, 1, 1}, {0, 1, 0}}}),
               std::invalid_argument);
}

}  // namespace
}  // namespace parity
