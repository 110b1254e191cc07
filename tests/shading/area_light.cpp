#include "gpu/shading/area_light.h"

#include <gtest/gtest.h>

#include <numbers>

#include "cpu_reference/shading/area_light.h"
#include "geometry/random.h"
#include "tests/shading/queries.h"
#include "tests/stage.h"

namespace parity {

auto fields_of(const RectangleQuery*) {
  return std::tuple{&RectangleQuery::corners, &RectangleQuery::point, &RectangleQuery::normal};
}
auto fields_of(const SphereQuery*) {
  return std::tuple{&SphereQuery::center, &SphereQuery::radius, &SphereQuery::to_eye,
                    &SphereQuery::alpha};
}

namespace {

using shading_test::u;

std::vector<RectangleQuery> random_rectangles(const Setting& setting) {
  Random random{setting.seed};
  std::vector<RectangleQuery> queries(std::size_t(setting.count("count")));
  for (RectangleQuery& q : queries) {
    const vec3 middle = random.direction() * float(setting.at("distance"));
    const vec3 s = random.direction(), other = random.direction();
    const vec3 t = glm::normalize(glm::cross(s, other + 0.1f)) * 0.7f;
    q.corners[0] = middle - 0.5f * s - 0.5f * t;
    q.corners[1] = q.corners[0] + s;
    q.corners[2] = q.corners[1] + t;
    q.corners[3] = q.corners[0] + t;
    q.point = random.in_box(0.05f);
    q.normal = random.direction();
  }
  return queries;
}

std::vector<SphereQuery> random_spheres(const Setting& setting) {
  Random random{setting.seed};
  std::vector<SphereQuery> queries(std::size_t(setting.count("count")));
  for (SphereQuery& q : queries) {
    q.to_eye = shading_test::upward(random, 0.2f);
    // Near the mirror direction, where something is to be seen, and above the horizon.
    const vec3 mirror{-q.to_eye.x, -q.to_eye.y, q.to_eye.z};
    q.center = 3.0f * glm::normalize(mirror + 0.3f * random.direction());
    q.center.z = std::max(q.center.z, 0.5f);
    q.alpha = float(std::pow(setting.at("roughness"), 2));
    q.radius = float(setting.at("radius"));
  }
  return queries;
}

Axis count_axis() {
  return {.name = "count",
          .low = 1,
          .high = 4099,
          .standard = 1031,
          .logarithmic = true,
          .whole = true};
}

const Registration rectangle = register_stage<std::vector<RectangleQuery>, std::vector<double>>({
    .name = "shading/rectangle_light",
    .title = "Irradiance of a rectangle in closed form, cut at the horizon",
    .source = "notes 6.1, 7; Lambert 1760; Baum et al. 1989",
    .axes = {count_axis(),
             {.name = "distance",
              .unit = "m",
              .low = 0.7,
              .high = 50,
              .standard = 2,
              .logarithmic = true}},
    .problem = random_rectangles,
    .cpu = {{.solve =
                 [](const std::vector<RectangleQuery>& q) { return cpu::rectangle_light(q); }}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const std::vector<RectangleQuery>& q) {
                   const std::vector<float> values = gpu::rectangle_light(context, q);
                   return std::vector<double>(values.begin(), values.end());
                 }}},
    .distance =
        [](const std::vector<double>& got, const std::vector<double>& want) {
          double worst = 0;
          for (std::size_t i = 0; i < want.size(); ++i)
            worst = std::max(worst, std::abs(got[i] - want[i]));
          return worst;
        },
    .tolerance =
        [](const std::vector<RectangleQuery>& queries) {
          double angles = 0;
          for (const RectangleQuery& q : queries) {
            double sum = 0;
            for (int k = 0; k < 4; ++k) {
              const dvec3 a = glm::normalize(dvec3(q.corners[k] - q.point));
              const dvec3 b = glm::normalize(dvec3(q.corners[(k + 1) % 4] - q.point));
              sum += 2 * std::asin(std::min(1.0, glm::length(a - b) / 2));
            }
            angles = std::max(angles, sum);
          }
          return 4096 * 2 * u * angles + 5 * 64 * u;
        },
    .why = "the arc tangent may be off by 4096 ULP of each edge's angle, of which half counts, and "
           "the edge along the horizon has no more than all others; five edges with cosines off by "
           "64 u",
    .error =
        [](const std::vector<RectangleQuery>& queries, const std::vector<double>& answer) {
          double worst = 0;
          for (std::size_t i = 0; i < std::min<std::size_t>(answer.size(), 20); ++i)
            worst = std::max(worst,
                             std::abs(answer[i] - cpu::rectangle_by_quadrature(queries[i], 200)));
          return worst;
        },
    .error_unit = "W/m^2",
});

/// 1 is what a perfect mirror shows.
double sphere_error(const std::vector<SphereQuery>& queries, const std::vector<double>& answer) {
  double sum = 0;
  const std::size_t count = std::min<std::size_t>(answer.size(), 40);
  for (std::size_t i = 0; i < count; ++i)
    sum += std::pow(answer[i] - cpu::sphere_by_quadrature(queries[i], 100), 2);
  return std::sqrt(sum / double(count));
}

const Registration sphere = register_stage<std::vector<SphereQuery>, std::vector<double>>({
    .name = "shading/sphere_light",
    .title = "A sphere in a rough mirror, by a representative point",
    .source = "notes 6.1; Karis 2013",
    .axes = {count_axis(),
             {.name = "roughness", .low = 0.1, .high = 1, .standard = 0.4},
             {.name = "radius",
              .unit = "m",
              .low = 0.001,
              .high = 1,
              .standard = 0.3,
              .logarithmic = true}},
    .problem = random_spheres,
    .cpu = {{.solve = [](const std::vector<SphereQuery>& q) { return cpu::sphere_light(q); }}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const std::vector<SphereQuery>& q) {
                   const std::vector<float> values = gpu::sphere_light(context, q);
                   return std::vector<double>(values.begin(), values.end());
                 }}},
    .distance =
        [](const std::vector<SphereQuery>& queries, const std::vector<double>& got,
           const std::vector<double>& want) {
          double worst = 0;
          for (std::size_t i = 0; i < want.size(); ++i) {
            const double bound = u * (want[i] + 1e-6) * (100 + 80 / double(queries[i].alpha));
            worst = std::max(worst, std::abs(got[i] - want[i]) / bound);
          }
          return worst;
        },
    .tolerance = 1.0,
    .why =
        "in units of (100 + 80 / alpha) u of the value: the nearest point is a difference of "
        "vectors of length 3, so the half vector is off by 20 u, and the lobe's logarithm has the "
        "slope 4 / alpha",
    .error = sphere_error,
    .error_unit = "radiance",
    .chart_axes = {"radius", "roughness"},
});

TEST(AreaLight, HasTheClosedFormsOfKnownRectangles) {
  // A square of side 2 at height 1, straight above: 4 corner rectangles of (1, 1) at 1, each with
  // the form factor (2 / 2 pi) (1 / sqrt 2) atan(1 / sqrt 2).
  RectangleQuery q{};
  const vec3 corners[4] = {{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
  std::copy(std::begin(corners), std::end(corners), q.corners);
  q.normal = {0, 0, 1};
  const double quarter = 2 / (2 * std::numbers::pi) * std::sqrt(0.5) * std::atan(std::sqrt(0.5));
  EXPECT_NEAR(cpu::rectangle_light(std::vector{q})[0], 4 * quarter * std::numbers::pi, 1e-12);
  // Half of it below the horizon: the rest is what quadrature gives.
  q.normal = {1, 0, 0};
  EXPECT_NEAR(cpu::rectangle_light(std::vector{q})[0], cpu::rectangle_by_quadrature(q, 400), 1e-5);
  q.normal = {0, 0, -1};
  EXPECT_EQ(cpu::rectangle_light(std::vector{q})[0], 0);
}

TEST(AreaLight, SmallSpheresAreExact) {
  SphereQuery q{};
  q.to_eye = glm::normalize(vec3(0.5f, 0.2f, 0.7f));
  q.center = vec3(-1.2f, -0.7f, 1.9f);
  q.alpha = 0.3f;
  q.radius = 0.003f;
  const double exact = cpu::sphere_by_quadrature(q, 100);
  EXPECT_NEAR(cpu::sphere_light(std::vector{q})[0] / exact, 1, 0.01);  // alpha + r / 2 d
}

}  // namespace
}  // namespace parity
