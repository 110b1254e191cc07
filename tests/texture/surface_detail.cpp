#include "cpu_reference/texture/surface_detail.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cpu_reference/texture/environment.h"
#include "gpu/texture/environment.h"
#include "gpu/texture/surface_detail.h"
#include "tests/stage.h"
#include "tests/texture/textures.h"

/// What textures do beside colour: bent normals, apparent depth; and pictures of all directions.
namespace parity {

inline auto fields_of(const SurfaceDetail*) {
  return std::tuple{&SurfaceDetail::normal, &SurfaceDetail::tangent, &SurfaceDetail::p_u,
                    &SurfaceDetail::p_v,    &SurfaceDetail::slope,   &SurfaceDetail::texel,
                    &SurfaceDetail::scale};
}
inline auto fields_of(const ParallaxRay*) {
  return std::tuple{&ParallaxRay::uv, &ParallaxRay::to_eye};
}

namespace {

double largest_length(const std::vector<dvec3>& got, const std::vector<dvec3>& want) {
  double worst = 0;
  for (std::size_t i = 0; i < want.size(); ++i)
    worst = std::max(worst, glm::distance(got[i], want[i]));
  return worst;
}

std::vector<dvec3> widened(const std::vector<vec3>& values) {
  return {values.begin(), values.end()};
}

/// Angles between derivatives, and between normal and tangent, of at least half a radian.
std::vector<SurfaceDetail> random_details(const Setting& setting) {
  Random random{setting.seed};
  std::vector<SurfaceDetail> details;
  while (details.size() < 2000) {
    SurfaceDetail d;
    d.normal = random.direction() * random.uniform(0.5f, 2.0f);
    d.tangent = vec4(random.direction(), random.below(2) == 0 ? -1.0f : 1.0f);
    d.p_u = random.direction() * random.uniform(0.1f, 10.0f);
    d.p_v = random.direction() * random.uniform(0.1f, 10.0f);
    const float steep = float(setting.at("steepness"));
    d.slope = steep * vec2(random.uniform(-1, 1), random.uniform(-1, 1));
    d.slope *= std::min(glm::length(d.p_u), glm::length(d.p_v));
    d.texel = {random.uniform(), random.uniform(), random.uniform(0.6f, 1.0f)};
    d.scale = steep;
    const auto sine = [](vec3 a, vec3 b) {
      return glm::length(glm::cross(glm::normalize(a), glm::normalize(b)));
    };
    if (sine(d.p_u, d.p_v) > 0.48f && sine(d.normal, vec3(d.tangent)) > 0.48f) details.push_back(d);
  }
  return details;
}

using Normals = std::vector<dvec3>;

Registration bent(const std::string& name, const std::string& title, const std::string& source,
                  dvec3 (*reference)(const SurfaceDetail&),
                  std::vector<vec3> (*device)(gpu::Context&, std::span<const SurfaceDetail>)) {
  return register_stage<std::vector<SurfaceDetail>, Normals>({
      .name = name,
      .title = title,
      .source = source,
      .rows = {118},
      .axes = {{.name = "steepness", .low = 0, .high = 4, .standard = 1}},
      .problem = random_details,
      .cpu = {{.solve =
                   [=](const std::vector<SurfaceDetail>& details) {
                     Normals normals;
                     for (const SurfaceDetail& d : details) normals.push_back(reference(d));
                     return normals;
                   }}},
      .gpu = {{.solve =
                   [=](gpu::Context& context, const std::vector<SurfaceDetail>& details) {
                     return widened(device(context, details));
                   }}},
      .distance = largest_length,
      .tolerance = 64 * 0x1p-24,
      .why = "products and sums of vectors of length 1, at most five deep, with cross products "
             "that lose a factor of 1 / sin of half a radian and bent vectors that are as short as "
             "0.2: (5 / 0.48) / 0.2 roundings of 2^-24, and two of the root",
  });
}

const Registration bumped = bent("texture/bump", "Normals of a surface that a height map raises",
                                 "notes 6.3; Blinn 1978", cpu::bump, gpu::bump);
const Registration mapped =
    bent("texture/normal_map", "Normals from a texture, in the tangent's basis",
         "notes 6.3; glTF 2.0, 3.9.3; Mikkelsen 2008", cpu::normal_map, gpu::normal_map);

struct ParallaxProblem {
  Grid<u8vec4> heights;
  std::vector<ParallaxRay> rays;
  float scale = 0;
  int layers = 1;
};
auto fields_of(const ParallaxProblem*) {
  return std::tuple{&ParallaxProblem::heights, &ParallaxProblem::rays};
}

ParallaxProblem make_parallax(const Setting& setting) {
  Random random{setting.seed};
  ParallaxProblem p;
  p.heights = Grid<u8vec4>{64, 48};
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) {
      const double wave = std::sin(x * 0.39269908) * std::cos(y * 0.5235988);
      p.heights(x, y) = u8vec4(u8vec4::value_type(127.5 + 120 * wave));
    }
  p.scale = float(setting.at("scale"));
  p.layers = setting.count("layers");
  for (int i = 0; i < 2000; ++i) {
    const vec3 eye = random.direction();
    p.rays.push_back({{random.uniform(-1, 2), random.uniform(-1, 2)},
                      {eye.x, eye.y, std::max(std::abs(eye.z), 0.1f)}});
  }
  return p;
}

/// Depths differ by rounding, or there is a layer before both at which the ray only just misses or
/// touches the field, and each is a place where the ray crosses it.
double parallax_distance(const ParallaxProblem& p, const std::vector<dvec3>& got,
                         const std::vector<dvec3>& want) {
  const double step = std::exp2(-cpu::parallax_bisections) / p.layers;
  const auto above = [&](const ParallaxRay& ray, double depth) {
    const dvec2 way = -dvec2(ray.to_eye) / double(ray.to_eye.z) * double(p.scale);
    return cpu::depth_at(p.heights, dvec2(ray.uv) + way * depth) - depth;
  };
  double worst = 0;
  for (std::size_t i = 0; i < want.size(); ++i) {
    const double apart = std::abs(got[i].z - want[i].z);
    bool touches = false;
    for (int layer = 0;
         layer <= p.layers && double(layer) / p.layers <= std::max(got[i].z, want[i].z); ++layer)
      touches |= std::abs(above(p.rays[i], double(layer) / p.layers)) < 1e-4;
    const bool crosses = got[i].z >= 1 || above(p.rays[i], got[i].z) < 1e-4;
    if (!(touches && crosses)) worst = std::max(worst, apart / step);
  }
  return worst;
}

/// Where the ray first meets the field, exactly: between lines through texels' centres the field
/// along the ray is a parabola, by its values at both ends and in the middle. 1 if it does not.
double exact_depth(const ParallaxProblem& p, const ParallaxRay& ray) {
  const dvec2 size{p.heights.width(), p.heights.height()};
  const dvec2 from = dvec2(ray.uv) * size - 0.5;
  const dvec2 way = -dvec2(ray.to_eye) / double(ray.to_eye.z) * double(p.scale) * size;
  const auto above = [&](double t) {  // the field's depth, less the ray's
    const dvec2 place = from + way * t, cell = glm::floor(place), share = place - cell;
    double depth = 0;
    for (int corner = 0; corner < 4; ++corner) {
      const ivec2 step{corner & 1, corner >> 1}, texel = ivec2(cell) + step;
      const int x = (texel.x % 64 + 64) % 64, y = (texel.y % 48 + 48) % 48;
      depth += (step.x ? share.x : 1 - share.x) * (step.y ? share.y : 1 - share.y) *
               (1 - p.heights(x, y).x / 255.0);
    }
    return depth - t;
  };
  std::vector<double> lines{0, 1};
  for (int axis = 0; axis < 2; ++axis)
    for (double line = std::ceil(std::min(from[axis], from[axis] + way[axis]));
         line < std::max(from[axis], from[axis] + way[axis]); ++line)
      lines.push_back((line - from[axis]) / way[axis]);
  std::ranges::sort(lines);
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    const double begin = lines[i], length = lines[i + 1] - begin;
    const double f0 = above(begin), f1 = above(begin + length / 2), f2 = above(begin + length);
    if (f0 <= 0) return begin;
    const double b = 4 * f1 - 3 * f0 - f2, c = 2 * (f0 + f2 - 2 * f1);  // f0 + b s + c s^2
    const double squared = b * b - 4 * c * f0;
    const double s = squared < 0 ? 2 : 2 * f0 / (-b + std::copysign(std::sqrt(squared), -b));
    const double other = squared < 0 || c == 0 ? 2 : f0 / (c * s);
    for (const double root : {std::min(s, other), std::max(s, other)})
      if (root >= 0 && root <= 1) return begin + root * length;
  }
  return 1;
}

/// Layers may miss a crossing, never find one before the first; and the first is one.
TEST(Parallax, LayersFindNothingBeforeTheFirstCrossing) {
  std::vector<Axis> axes{{.name = "scale", .standard = 0.1}, {.name = "layers", .standard = 24}};
  const ParallaxProblem p = make_parallax(Setting(axes));
  for (const ParallaxRay& ray : p.rays) {
    const double first = exact_depth(p, ray);
    const dvec2 way = -dvec2(ray.to_eye) / double(ray.to_eye.z) * double(p.scale);
    // Depths to 1e-12: places of up to 600 texels in double.
    if (first < 1) {
      EXPECT_NEAR(cpu::depth_at(p.heights, dvec2(ray.uv) + way * first), first, 1e-12);
    }
    const auto hit = cpu::parallax(p.heights, dvec2(ray.uv), dvec3(ray.to_eye), p.scale, 24);
    EXPECT_LE(first, hit.depth + 1 / 24.0 / 256);
  }
}

const Registration parallax = register_stage<ParallaxProblem, std::vector<dvec3>>({
    .name = "texture/parallax",
    .title = "Apparent depth: where rays meet a height field below a surface",
    .source = "notes 6.3; Brawley & Tatarchuk 2004",
    .rows = {118},
    .axes = {{.name = "layers",
              .low = 1,
              .high = 128,
              .standard = 24,
              .logarithmic = true,
              .whole = true},
             {.name = "scale", .unit = "texture", .low = 0, .high = 0.2, .standard = 0.05}},
    .problem = make_parallax,
    .cpu = {{.solve =
                 [](const ParallaxProblem& p) {
                   std::vector<dvec3> hits;
                   for (const ParallaxRay& ray : p.rays) {
                     const cpu::ParallaxHit hit = cpu::parallax(
                         p.heights, dvec2(ray.uv), dvec3(ray.to_eye), p.scale, p.layers);
                     hits.emplace_back(hit.uv, hit.depth);
                   }
                   return hits;
                 }}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const ParallaxProblem& p) {
                   return widened(gpu::parallax(context, p.heights, p.rays, p.scale, p.layers));
                 }}},
    .distance = parallax_distance,
    .tolerance = 1.01,
    .why = "in steps of the bisection: one decision of it may fall the other way by rounding; a "
           "layer at which the ray passes the field at less than 1e-4 (float places of up to 500 "
           "texels, slopes of up to 0.1 a texel) may be taken or not",
    .error =
        [](const ParallaxProblem& p, const std::vector<dvec3>& hits) {
          double sum = 0;
          for (std::size_t i = 0; i < hits.size(); ++i)
            sum += std::abs(hits[i].z - exact_depth(p, p.rays[i]));
          return sum / double(hits.size());
        },
    .error_unit = "depth",
    .chart_axes = {"layers"},
});

struct Directions {
  Grid<vec4> picture;
  std::vector<vec3> directions;
  bool cube = false;
};
auto fields_of(const Directions*) {
  return std::tuple{&Directions::picture, &Directions::directions};
}

/// Every fourth direction is near an edge or corner of the cube, or a pole.
Directions make_directions(const Setting& setting) {
  Random random{setting.seed};
  Directions p;
  p.cube = setting.count("cube") != 0;
  const int side = setting.count("side");
  p.picture = p.cube ? Grid<vec4>{side, 6 * side} : Grid<vec4>{2 * side, side};
  for (vec4& texel : p.picture)
    texel = {random.uniform(), random.uniform(), random.uniform(), random.uniform()};
  for (int i = 0; i < 4000; ++i) {
    vec3 d = random.direction();
    if (i % 4 == 0) d = glm::round(d * 1.2f) + random.in_box(0.02f);
    if (glm::length(d) > 0.1f) p.directions.push_back(d);
  }
  return p;
}

const Registration environment = register_stage<Directions, std::vector<dvec4>>({
    .name = "texture/environment",
    .title = "Pictures of all directions: equirectangular and cube maps, without seams",
    .source = "notes 6.3; Vulkan 1.3, Cube Map Edge Handling",
    .rows = {116},
    .axes = {{.name = "cube", .low = 0, .high = 1, .standard = 0, .whole = true, .each = true},
             {.name = "side",
              .unit = "texel",
              .low = 1,
              .high = 64,
              .standard = 16,
              .logarithmic = true,
              .whole = true}},
    .problem = make_directions,
    .cpu = {{.solve =
                 [](const Directions& p) {
                   std::vector<dvec4> colors;
                   for (const vec3& d : p.directions)
                     colors.push_back(p.cube ? cpu::sample_cube_map(p.picture, dvec3(d))
                                             : cpu::sample_equirectangular(p.picture, dvec3(d)));
                   return colors;
                 }}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const Directions& p) {
                   const std::vector<vec4> colors =
                       p.cube ? gpu::sample_cube_map(context, p.picture, p.directions)
                              : gpu::sample_equirectangular(context, p.picture, p.directions);
                   return std::vector<dvec4>(colors.begin(), colors.end());
                 }}},
    .distance =
        [](const std::vector<dvec4>& got, const std::vector<dvec4>& want) {
          double worst = 0;
          for (std::size_t i = 0; i < want.size(); ++i) {
            const dvec4 apart = glm::abs(got[i] - want[i]);
            worst = std::max({worst, apart.x, apart.y, apart.z, apart.w});
          }
          return worst;
        },
    .tolerance = [](const Directions& p) { return (4.0 * p.picture.width() + 16) * 0x1p-21; },
    .why = "a place is off by 2^-21 of the width on each axis, between texels that differ by up to "
           "1; four products and sums",
});

}  // namespace
}  // namespace parity
