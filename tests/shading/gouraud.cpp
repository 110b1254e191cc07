#include "gpu/shading/gouraud.h"

#include <gtest/gtest.h>

#include "cpu_reference/shading/gouraud.h"
#include "geometry/random.h"
#include "tests/shading/queries.h"
#include "tests/stage.h"

namespace parity {

auto fields_of(const GouraudQuery*) {
  return std::tuple{&GouraudQuery::corners, &GouraudQuery::normals, &GouraudQuery::light,
                    &GouraudQuery::eye,     &GouraudQuery::place,   &GouraudQuery::specular,
                    &GouraudQuery::exponent};
}

namespace {

using shading_test::u;
using Queries = std::vector<GouraudQuery>;

/// A triangle of side about 1 with normals up to 30 degrees apart from +z.
GouraudQuery bent_triangle(Random& random, float specular, float exponent) {
  GouraudQuery q{};
  const vec3 corners[3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (int k = 0; k < 3; ++k) {
    q.corners[k] = corners[k] + random.in_box(0.2f);
    q.normals[k] = glm::normalize(vec3(0, 0, 2) + random.direction());
  }
  q.light = vec3(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(1, 3));
  q.eye = vec3(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(1, 3));
  const float a = random.uniform(), b = random.uniform();
  q.place = a + b > 1 ? vec3(1 - a, 1 - b, a + b - 1) : vec3(a, b, 1 - a - b);
  q.specular = specular;
  q.exponent = exponent;
  return q;
}

Queries random_triangles(const Setting& setting) {
  Random random{setting.seed};
  Queries queries;
  for (int i = 0; i < setting.count("count"); ++i)
    queries.push_back(bent_triangle(random, 0.5f, float(setting.at("exponent"))));
  return queries;
}

/// Positions up to 4 and distances of 0.8 or more: a direction is off by 20 u, cosines by 64 u. The
/// highlight's slope is factor e at most, factor <= (e + 8) / 8 pi; its power costs e 2^-21 of it.
double bound(const GouraudQuery& q) {
  const double peak = (q.exponent + 8) / 25;
  return 2 * (64 * u * (1 + peak * (1 + q.exponent)) + peak * q.exponent * 0x1p-21);
}

double distance(const Queries& queries, const std::vector<dvec2>& got,
                const std::vector<dvec2>& want) {
  double worst = 0;
  for (std::size_t i = 0; i < want.size(); ++i)
    for (int c = 0; c < 2; ++c)
      worst = std::max(worst, std::abs(got[i][c] - want[i][c]) / bound(queries[i]));
  return worst;
}

const Registration registration = register_stage<Queries, std::vector<dvec2>>({
    .name = "shading/gouraud",
    .title = "Colours interpolated from the corners, and normals interpolated for each point",
    .source = "notes 6.1; Gouraud 1971; Phong 1975",
    .rows = {103},
    .axes = {{.name = "count",
              .low = 1,
              .high = 4099,
              .standard = 1031,
              .logarithmic = true,
              .whole = true},
             {.name = "exponent", .low = 1, .high = 1000, .standard = 32, .logarithmic = true}},
    .problem = random_triangles,
    .cpu = {{.solve = [](const Queries& q) { return cpu::gouraud(q); }}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const Queries& q) {
                   const std::vector<vec2> values = gpu::gouraud(context, q);
                   return std::vector<dvec2>(values.begin(), values.end());
                 }}},
    .distance = distance,
    .tolerance = 1.0,
    .why = "in units of a bound: cosines are off by 64 u, the highlight is steeper by its exponent "
           "and "
           "its peak, and its power has Vulkan's log2, 2^-21 times the exponent",
});

/// Light and eye far away along (0, 0.6, 0.8): shading without a highlight is linear in the normal.
GouraudQuery from_far(float specular, float exponent) {
  GouraudQuery q{};
  q.corners[1] = {1, 0, 0};
  q.corners[2] = {0, 1, 0};
  q.light = 1e5f * vec3(0, 0.6f, 0.8f);
  q.eye = q.light;
  q.place = vec3(1.0f / 3);
  q.specular = specular;
  q.exponent = exponent;
  return q;
}

TEST(Gouraud, EqualsPhongWhereShadingIsLinear) {
  GouraudQuery q = from_far(0, 1);
  for (vec3& n : q.normals) n = {0, 0, 1};
  const dvec2 flat = cpu::gouraud(std::vector{q})[0];
  EXPECT_NEAR(flat.x / flat.y, 1, 1e-4);  // positions move by 1 of 1e5
}

TEST(Gouraud, LosesAHighlightBetweenTheCorners) {
  GouraudQuery q = from_far(1, 200);
  q.normals[0] = glm::normalize(vec3(0.5f, 0.6f, 0.8f));
  q.normals[1] = glm::normalize(vec3(-0.25f, 0.6f + 0.4f, 0.5f));
  q.normals[2] = glm::normalize(vec3(-0.25f, 0.2f, 1.1f));
  const dvec2 lost = cpu::gouraud(std::vector{q})[0];
  EXPECT_LT(lost.x, 0.01 * lost.y);
}

}  // namespace
}  // namespace parity
