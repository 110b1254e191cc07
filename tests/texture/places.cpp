#include <algorithm>
#include <cmath>

#include "cpu_reference/texture/procedural.h"
#include "cpu_reference/texture/projection.h"
#include "geometry/random.h"
#include "gpu/texture/procedural.h"
#include "gpu/texture/projection.h"
#include "tests/stage.h"

/// Functions of a place in space: projections into textures, and textures without an image.
namespace parity {
namespace {

struct Places {
  std::vector<vec3> points;
  std::uint32_t kind = 0;
};
auto fields_of(const Places*) { return std::tuple{&Places::points}; }

std::vector<vec3> random_points(const Setting& setting, int count) {
  Random random{setting.seed};
  const float reach = float(setting.at("reach"));
  std::vector<vec3> points;
  for (int i = 0; i < count; ++i) {
    vec3 p = random.in_box(reach);
    // Axes, diagonals and lattice points, where cases meet.
    if (i % 4 == 0) p = glm::round(p / reach * 2.0f) * (reach / 2);
    if (i % 8 == 1) p = glm::floor(p);
    if (p == vec3(0.0f)) p = {0, 0, -reach};
    points.push_back(p);
  }
  return points;
}

/// Distance of texture coordinates; u of the angle around wraps; a direction on the border between
/// faces may be on either.
double apart(const Places& p, std::size_t i, dvec3 got, dvec3 want) {
  if (p.kind == 1 || p.kind == 2) {
    const double around = std::abs(got.x - want.x);
    const bool pole = p.points[i].x == 0 && p.points[i].z == 0;  // u is anything there
    return std::max(pole ? 0 : std::min(around, 1 - around), std::abs(got.y - want.y));
  }
  return std::max({std::abs(got.x - want.x), std::abs(got.y - want.y), std::abs(got.z - want.z)});
}

std::vector<dvec3> project_all(const Places& p) {
  std::vector<dvec3> places;
  for (const vec3& point : p.points) {
    if (p.kind == 4) {
      places.push_back(cpu::triplanar_weights(dvec3(point)));
      continue;
    }
    const cpu::TexturePoint place = cpu::project(Projection(p.kind), dvec3(point));
    places.emplace_back(place.uv, place.face);
  }
  return places;
}

const Registration projection = register_stage<Places, std::vector<dvec3>>({
    .name = "texture/projection",
    .title = "Planar, cylindrical, spherical, cubic and triplanar projection",
    .source = "notes 6.3; Vulkan 1.3, Cube Map Face Selection; Geiss 2007",
    .rows = {116},
    .axes = {{.name = "kind", .low = 0, .high = 4, .standard = 2, .whole = true, .each = true},
             {.name = "reach", .low = 0.01, .high = 100, .standard = 1, .logarithmic = true}},
    .problem =
        [](const Setting& setting) {
          return Places{random_points(setting, 4000), std::uint32_t(setting.count("kind"))};
        },
    .cpu = {{.solve = project_all}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const Places& p) {
                   const std::vector<vec3> places =
                       p.kind == 4 ? gpu::triplanar_weights(context, p.points)
                                   : gpu::project(context, Projection(p.kind), p.points);
                   return std::vector<dvec3>(places.begin(), places.end());
                 }}},
    .distance =
        [](const Places& p, const std::vector<dvec3>& got, const std::vector<dvec3>& want) {
          double worst = 0;
          for (std::size_t i = 0; i < want.size(); ++i)
            worst = std::max(worst,
                             apart(p, i, got[i], want[i]) /
                                 std::max(1.0, std::max(std::abs(want[i].x), std::abs(want[i].y))));
          return worst;
        },
    .tolerance = 0x1p-21,
    .why = "relative to coordinates above 1: angles are off by 2^-22 of up to pi, divided by pi or "
           "more; quotients and sums of floats by 4 2^-24",
});

std::vector<double> procedural_all(const Places& p) {
  std::vector<double> values;
  for (const vec3& point : p.points)
    values.push_back(cpu::procedural(Procedural(p.kind), dvec3(point)));
  return values;
}

Registration procedural(const std::string& name, const std::string& title, int low, int high) {
  return register_stage<Places, std::vector<double>>({
      .name = name,
      .title = title,
      .source = "notes 6.3; Perlin 1985, 2002; Worley 1996",
      .rows = {117},
      .axes = {{.name = "kind",
                .low = double(low),
                .high = double(high),
                .standard = double(low),
                .whole = true,
                .each = true},
               {.name = "reach", .low = 1, .high = 300, .standard = 8, .logarithmic = true}},
      .problem =
          [](const Setting& setting) {
            return Places{random_points(setting, 4000), std::uint32_t(setting.count("kind"))};
          },
      .cpu = {{.solve = procedural_all}},
      .gpu = {{.solve =
                   [](gpu::Context& context, const Places& p) {
                     const auto values = gpu::procedural(context, Procedural(p.kind), p.points);
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
          [](const Places& p) {
            double largest = 0;
            for (const vec3& point : p.points)
              largest = std::max(largest, double(glm::length(point)));
            return (1500 + 48 * largest) * 0x1p-24;
          },
      .why =
          "a fade is off by 60 2^-24, times differences of up to 4 on three axes, for octaves of "
          "weights 2 in sum; veins and rings multiply by pi or 2 what a float of the radius or "
          "of x loses, 4 2^-24 of up to four times the largest coordinate",
      .chart_axes = {"reach"},
  });
}

const Registration noise =
    procedural("texture/perlin_noise", "Gradient noise, its octaves, and turbulence", 0, 2);
const Registration others =
    procedural("texture/procedural", "Cells, marble and wood, made of points and noise", 3, 5);

}  // namespace
}  // namespace parity
