#include "cpu_reference/raster/clip.h"

#include "geometry/random.h"
#include "gpu/raster/clip.h"
#include "tests/numbers.h"
#include "tests/stage.h"

namespace parity {

inline auto fields_of(const ClippedPolygon*) {
  return std::tuple{&ClippedPolygon::count, &ClippedPolygon::position,
                    &ClippedPolygon::barycentric};
}

namespace {

constexpr float guard_band = 4;

/// Corners on all sides of the view volume, before and behind the eye.
TriangleList straddling_triangles(const Setting& setting) {
  Random random{setting.seed};
  const float reach = float(setting.at("reach"));
  TriangleList list;
  list.width = list.height = 64;
  for (int i = 0; i < setting.count("count"); ++i) {
    const auto first = std::uint32_t(list.clip_positions.size());
    for (int k = 0; k < 3; ++k) {
      const float w = random.uniform(-0.5f, 2.0f);
      list.clip_positions.push_back({random.uniform(-reach, reach), random.uniform(-reach, reach),
                                     random.uniform(-0.5f, 2.0f), w});
    }
    list.triangles.push_back({first, first + 1, first + 2});
  }
  return list;
}

/// Area and first moments in barycentric coordinates of the triangle: what is left of it, whichever
/// corner the polygon begins with and however often it repeats one.
dvec3 moments(const ClippedPolygon& p) {
  dvec3 sum{0.0};
  const auto at = [&](std::size_t i) { return dvec2(p.barycentric[i].y, p.barycentric[i].z); };
  for (std::size_t i = 1; i + 1 < p.count; ++i) {
    const dvec2 a = at(0), b = at(i), c = at(i + 1);
    const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    sum += area * dvec3(1.0, (a + b + c) / 3.0);
  }
  return sum;
}

/// How badly conditioned the points of intersection of a triangle are: the size of its corners over
/// the smallest difference of distances to a plane that some edge crosses.
double condition(const TriangleList& list) {
  double worst = 1;
  for (const uvec3& t : list.triangles)
    for (int i = 0; i < 3; ++i) {
      const dvec4 a{list.clip_positions[t[i]]};
      const dvec4 b{list.clip_positions[t[(i + 1) % 3]]};
      const auto distances = [](const dvec4& c) {
        return std::array<double, 7>{c.w,
                                     c.z,
                                     c.w - c.z,
                                     guard_band * c.w + c.x,
                                     guard_band * c.w - c.x,
                                     guard_band * c.w + c.y,
                                     guard_band * c.w - c.y};
      };
      const double size = std::max(glm::length(a), glm::length(b)) * guard_band;
      for (int plane = 0; plane < 7; ++plane) {
        const double da = distances(a)[std::size_t(plane)], db = distances(b)[std::size_t(plane)];
        if ((da < 0) != (db < 0)) worst = std::max(worst, size / std::abs(da - db));
      }
    }
  return worst;
}

const Registration registration = register_stage<TriangleList, std::vector<ClippedPolygon>>({
    .name = "raster/clip",
    .title = "The part of a triangle before the eye and inside the view volume and guard band",
    .source = "notes 1.1; Sutherland & Hodgman 1974; Blinn & Newell 1978",
    .rows = {1},
    .axes = {{.name = "count",
              .low = 1,
              .high = 4099,
              .standard = 131,
              .logarithmic = true,
              .whole = true},
             {.name = "reach", .low = 0.5, .high = 100, .standard = 4, .logarithmic = true}},
    .problem = straddling_triangles,
    .cpu = {{.solve = [](const TriangleList& list) { return cpu::clip(list, guard_band); }}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const TriangleList& list) {
                   return gpu::clip(context, list, guard_band);
                 }}},
    .distance =
        [](const std::vector<ClippedPolygon>& got, const std::vector<ClippedPolygon>& want) {
          double worst = 0;
          for (std::size_t i = 0; i < want.size(); ++i) {
            const dvec3 apart = glm::abs(moments(got[i]) - moments(want[i]));
            worst = std::max({worst, apart.x, apart.y, apart.z});
          }
          return worst;
        },
    .tolerance = [](const TriangleList& list) { return 7 * 8 * 0x1p-24 * condition(list); },
    .why = "area and moments of what is left, in barycentric coordinates of the whole (area 1): a "
           "point of "
           "intersection is a / (a - b) along an edge, wrong by 8 u times the corners' size over "
           "|a - b|; seven "
           "planes in turn",
    .chart_axes = {"count"},
});

}  // namespace
}  // namespace parity
