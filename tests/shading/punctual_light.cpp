#include "gpu/shading/punctual_light.h"

#include <gtest/gtest.h>

#include <numbers>

#include "cpu_reference/shading/punctual_light.h"
#include "geometry/random.h"
#include "tests/stage.h"

namespace parity {

auto fields_of(const Light*) {
  return std::tuple{&Light::kind,
                    &Light::color,
                    &Light::intensity,
                    &Light::range,
                    &Light::inner_cone_angle,
                    &Light::outer_cone_angle};
}
auto fields_of(const PlacedLight*) {
  return std::tuple{&PlacedLight::light, &PlacedLight::position, &PlacedLight::direction};
}

namespace {

struct LitPoints {
  std::vector<PlacedLight> lights;
  std::vector<vec3> points;
};
auto fields_of(const LitPoints*) { return std::tuple{&LitPoints::lights, &LitPoints::points}; }

LitPoints random_lights(const Setting& setting) {
  Random random{setting.seed};
  LitPoints p;
  for (int i = 0; i < setting.count("count"); ++i) {
    PlacedLight light;
    light.light.kind = LightKind(setting.count("kind"));
    light.light.intensity = random.uniform(0.1f, 100);
    if (random.below(2) == 0) light.light.range = random.uniform(0.5f, 5);
    light.light.outer_cone_angle = random.uniform(0.1f, 1.5f);
    light.light.inner_cone_angle = light.light.outer_cone_angle * random.uniform(0, 0.95f);
    light.position = dvec3(random.in_box(2));
    light.direction = glm::normalize(dvec3(random.direction()));
    p.lights.push_back(light);
    // In front of the light, so that cones matter.
    p.points.push_back(vec3(light.position + light.direction * double(random.uniform(0.2f, 4))) +
                       random.in_box(0.5f));
  }
  return p;
}

using cpu::Interval;
using Answers = std::vector<dvec4>;

Answers on_cpu(const LitPoints& p) {
  Answers answers;
  for (std::size_t i = 0; i < p.points.size(); ++i) {
    const cpu::Incoming<double> in =
        cpu::incoming(p.lights[i], cpu::triple<double>(dvec3(p.points[i])));
    answers.emplace_back(in.to_light.x, in.to_light.y, in.to_light.z, in.irradiance);
  }
  return answers;
}

/// In units of what single precision may do to each.
double distance(const LitPoints& p, const Answers& got, const Answers& want) {
  double worst = 0;
  for (std::size_t i = 0; i < want.size(); ++i) {
    const dvec3 point{p.points[i]};
    const cpu::Incoming<Interval> in = cpu::incoming<Interval>(
        p.lights[i], {Interval(point.x), Interval(point.y), Interval(point.z)});
    const std::array<Interval, 4> range{in.to_light.x, in.to_light.y, in.to_light.z, in.irradiance};
    for (int c = 0; c < 4; ++c) {
      const double apart = std::abs(got[i][c] - want[i][c]);
      const double bound = cpu::deviation(range[std::size_t(c)], want[i][c]);
      if (apart > 0) worst = std::max(worst, apart / bound);
    }
  }
  return worst;
}

const Registration registration = register_stage<LitPoints, Answers>({
    .name = "shading/punctual_light",
    .title = "Directional, point and spot lights",
    .source = "notes 6.1; glTF 2.0, KHR_lights_punctual",
    .rows = {104},
    .axes = {{.name = "count",
              .low = 1,
              .high = 4099,
              .standard = 1031,
              .logarithmic = true,
              .whole = true},
             {.name = "kind", .low = 0, .high = 2, .standard = 2, .whole = true, .each = true}},
    .problem = random_lights,
    .cpu = {{.solve = on_cpu}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const LitPoints& p) {
                   const std::vector<vec4> values =
                       gpu::punctual_light(context, p.lights, p.points);
                   return Answers(values.begin(), values.end());
                 }}},
    .distance = distance,
    .tolerance = 1.0,
    .why = "in units of the interval that Vulkan's error bounds leave for each number",
});

PlacedLight spot() {
  PlacedLight light;
  light.light.kind = LightKind::spot;
  light.light.intensity = 8;
  light.light.inner_cone_angle = 0.3f;
  light.light.outer_cone_angle = 0.6f;
  light.direction = {0, 0, -1};
  return light;
}

double irradiance_at(const PlacedLight& light, const dvec3& point) {
  return cpu::incoming(light, cpu::triple<double>(point)).irradiance;
}

TEST(PunctualLight, FallsOffWithTheSquareOfTheDistance) {
  PlacedLight light = spot();
  light.light.kind = LightKind::point;
  EXPECT_DOUBLE_EQ(irradiance_at(light, {0, 0, -1}), 8);
  EXPECT_DOUBLE_EQ(irradiance_at(light, {0, 4, 0}), 0.5);
  light.light.kind = LightKind::directional;
  EXPECT_EQ(irradiance_at(light, {0, 0, -100}), 8);
  light.light.kind = LightKind::point;
  light.light.range = 2;
  EXPECT_EQ(irradiance_at(light, {0, 2, 0}), 0);
}

/// Checklist row 104: the law between the cones is left open by the notes.
TEST(PunctualLight, SpotsEndAtTheirConesWithoutAnEdge) {
  const PlacedLight light = spot();
  const auto at = [&](double angle) {
    return irradiance_at(light, {std::sin(angle), 0, -std::cos(angle)});
  };
  EXPECT_DOUBLE_EQ(at(0.29), 8);
  EXPECT_NEAR(at(0.6), 0, 1e-12);
  EXPECT_EQ(at(0.61), 0);
  EXPECT_NEAR(at(0.5999) / 8, 0, 1e-6);  // the square of a ramp leaves zero without a corner
  const double middle = std::acos((std::cos(0.3f) + std::cos(0.6f)) / 2);
  EXPECT_NEAR(at(middle), 8 * 0.25, 1e-6);
}

}  // namespace
}  // namespace parity
