#include "gpu/shading/gouraud.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "cpu_reference/shading/gouraud.h"
#include "geometry/random.h"
#include "tests/chart.h"
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

/// Lambert's cosine is linear in the normal as it is interpolated; Phong divides by its length.
TEST(Gouraud, IsPhongWithNormalsLeftAtTheirLength) {
  GouraudQuery q = from_far(0, 1);
  q.normals[0] = glm::normalize(vec3(0.9f, 0, 1));
  q.normals[1] = glm::normalize(vec3(-0.5f, 0.8f, 1));
  q.normals[2] = glm::normalize(vec3(0, -0.6f, 1));
  for (const vec3 place : {vec3(1, 1, 1), vec3(4, 1, 1), vec3(1, 3, 0), vec3(0, 1, 5)}) {
    q.place = place / (place.x + place.y + place.z);
    const vec3 normal =
        q.place.x * q.normals[0] + q.place.y * q.normals[1] + q.place.z * q.normals[2];
    const dvec2 both = cpu::gouraud(std::vector{q})[0];
    // Positions move by 1 of 1e5: squared distances and cosines by a few 1e-5.
    EXPECT_NEAR(both.x / both.y, double(glm::length(normal)), 1e-4);
    EXPECT_LT(both.x, 0.99 * both.y) << "the test needs normals that differ";
  }
}

GouraudQuery lit_from_above(Random& random) {
  GouraudQuery q = bent_triangle(random, 0.5f, 8);
  q.light = {0.3f, 0.4f, 2};
  q.eye = {-0.5f, 0.2f, 2};
  return q;
}

TEST(Gouraud, EqualsPhongAtCorners) {
  Random random{4};
  for (int i = 0; i < 20; ++i)
    for (int k = 0; k < 3; ++k) {
      GouraudQuery q = lit_from_above(random);
      q.place = vec3(0);
      q.place[k] = 1;
      const dvec2 both = cpu::gouraud(std::vector{q})[0];
      EXPECT_NEAR(both.x, both.y,
                  16 * u * both.y);  // normals have length 1 to u, to the power of 9
    }
}

/// Of a triangle cut into n^2 the one around `place`, lit by the normals that Phong has at its
/// corners. Lattice coordinates: corners lie a step above their whole part, or a step below the
/// next where the triangle stands on its head.
GouraudQuery part_of(const GouraudQuery& q, int n) {
  const dvec3 scaled = dvec3(q.place) * double(n), whole = glm::floor(scaled);
  const bool upright = std::lround(whole.x + whole.y + whole.z) == n - 1;
  GouraudQuery part = q;
  part.place = vec3(upright ? scaled - whole : 1.0 - (scaled - whole));
  for (int k = 0; k < 3; ++k) {
    dvec3 corner = upright ? whole : whole + 1.0;
    corner[k] += upright ? 1 : -1;
    dvec3 position{0.0}, normal{0.0};
    for (int c = 0; c < 3; ++c) {
      position += corner[c] / n * dvec3(q.corners[c]);
      normal += corner[c] / n * dvec3(q.normals[c]);
    }
    part.corners[k] = vec3(position);
    part.normals[k] = vec3(glm::normalize(normal));
  }
  return part;
}

/// Root of the mean square of what Gouraud on triangles cut into n^2 is away from Phong on whole
/// ones.
using Shade = std::function<std::vector<dvec2>(const Queries&)>;
double subdivision_error(const Shade& shade, float exponent, int n) {
  Random random{9};
  Queries whole, parts;
  for (int i = 0; i < 1000; ++i) {
    whole.push_back(lit_from_above(random));
    whole.back().exponent = exponent;
    parts.push_back(part_of(whole.back(), n));
  }
  const std::vector<dvec2> want = shade(whole), got = shade(parts);
  double sum = 0;
  for (std::size_t i = 0; i < want.size(); ++i) sum += std::pow(got[i].x - want[i].y, 2);
  return std::sqrt(sum / double(want.size()));
}

TEST(Gouraud, ComesToPhongAsTheSquareOfTheTrianglesSide) {
  const Shade on_cpu = [](const Queries& q) { return cpu::gouraud(q); };
  for (const int n : {8, 16, 32})  // the next term is as the fourth power: 1 / 64 of the first
    EXPECT_NEAR(std::log2(subdivision_error(on_cpu, 8, n) / subdivision_error(on_cpu, 8, 2 * n)), 2,
                0.1)
        << n;
}

ChartData error_of_subdivision(gpu::Context& context) {
  const Shade on_device = [&](const Queries& q) {
    const std::vector<vec2> values = gpu::gouraud(context, q);
    return std::vector<dvec2>(values.begin(), values.end());
  };
  ChartData data;
  for (const float exponent : {1.0f, 32.0f, 200.0f}) {
    Series series{"exponent " + short_number(exponent), {}};
    for (int n = 1; n <= 64; n *= 2)
      series.points.push_back({double(n), subdivision_error(on_device, exponent, n)});
    data.assertions.push_back({series.name + ": order from 32 to 64 parts",
                               std::log2(series.points[5].y / series.points[6].y), 1.8,
                               Assertion::Relation::at_least});
    data.series.push_back(series);
  }
  data.settings = {{"surfaces", "1000 bent triangles, half matt and half shiny"}};
  return data;
}

const Registration chart = register_chart({
    .name = "shading/gouraud",
    .title =
        "Colours interpolated in parts of a triangle against normals interpolated in all of it",
    .x = {.label = "parts of an edge", .unit = "1"},
    .y = {.label = "root mean square error", .unit = "W/(m² sr)"},
    .produce = error_of_subdivision,
    .fit_slopes = true,
});

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
