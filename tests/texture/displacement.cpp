#include "cpu_reference/texture/displacement.h"

#include <algorithm>
#include <cmath>

#include "cpu_reference/texture/procedural.h"
#include "gpu/texture/displacement.h"
#include "tests/chart.h"
#include "tests/stage.h"

namespace parity {

inline auto fields_of(const DisplacementCorner*) {
  return std::tuple{&DisplacementCorner::position, &DisplacementCorner::normal,
                    &DisplacementCorner::uv};
}
inline auto fields_of(const DisplacementProblem*) {
  return std::tuple{&DisplacementProblem::corners, &DisplacementProblem::heights};
}
inline auto fields_of(const DisplacedMesh*) {
  return std::tuple{&DisplacedMesh::factors, &DisplacedMesh::corners};
}

namespace {

/// A floor of `side`^2 squares of two triangles each, seen from close above one end.
DisplacementProblem hills(int side, float max_pixels, float scale) {
  DisplacementProblem p;
  p.heights = Grid<u8vec4>{128, 128};
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x) {
      const double noise = cpu::procedural(Procedural::perlin, {x / 16.0, y / 16.0, 0.5});
      p.heights(x, y) = u8vec4(u8vec4::value_type(127.5 + 110 * noise));
    }
  p.scale = scale;
  p.max_pixels = max_pixels;
  p.size = {512, 512};
  const auto corner = [&](int x, int y) {
    const vec2 uv = vec2(x, y) / float(side);
    return DisplacementCorner{{4 * uv.x - 2, 0, -1 - 6 * uv.y}, {0, 1, 0}, uv};
  };
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      for (const ivec2 c :
           {ivec2(0, 0), ivec2(1, 0), ivec2(1, 1), ivec2(0, 0), ivec2(1, 1), ivec2(0, 1)})
        p.corners.push_back(corner(x + c.x, y + c.y));
  // From (0, 1, 0) along -z: x / -z, (1 - y) / -z.
  p.clip_from_world = mat4(0.0f);
  p.clip_from_world[0][0] = 1;
  p.clip_from_world[1][1] = -1;
  p.clip_from_world[3][1] = 1;
  p.clip_from_world[2][3] = -1;
  return p;
}

bool is_near_a_tie(const DisplacementProblem& p, const std::array<double, 6>& errors,
                   std::uint32_t factor) {
  for (int level = 0; level < 6; ++level)
    if ((1u << level) <= factor &&
        std::abs(errors[std::size_t(level)] - double(p.max_pixels)) < 2e-3)
      return true;
  return false;
}

/// Factors may differ where an error is within rounding of the limit; for the factors that there
/// are, every corner must be where it belongs.
double distance(const DisplacementProblem& p, const DisplacedMesh& got, const DisplacedMesh& want) {
  for (std::size_t i = 0; i < want.factors.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t g = got.factors[i][k], w = want.factors[i][k];
      const auto errors = cpu::edge_errors(p, p.corners[3 * i + std::size_t((k + 1) % 3)],
                                           p.corners[3 * i + std::size_t((k + 2) % 3)]);
      if (g != w && !is_near_a_tie(p, errors, std::max(g, w)))
        return std::numeric_limits<double>::infinity();
    }
  const std::vector<dvec3> corners = cpu::displaced_corners(p, got.factors);
  double worst = corners.size() == got.corners.size() ? 0 : std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < std::min(corners.size(), got.corners.size()); ++i)
    worst = std::max(worst, glm::distance(corners[i], dvec3(got.corners[i])));
  return worst;
}

const Registration registration = register_stage<DisplacementProblem, DisplacedMesh>({
    .name = "texture/displacement",
    .title = "True displacement, cut as finely as the picture needs",
    .source = "notes 6.3; Cook 1984; Moule & McCool 2002",
    .rows = {118},
    .axes = {{.name = "max_pixels",
              .unit = "px",
              .low = 0.25,
              .high = 32,
              .standard = 2,
              .logarithmic = true},
             {.name = "scale", .unit = "m", .low = 0, .high = 1, .standard = 0.4}},
    .problem =
        [](const Setting& setting) {
          return hills(3, float(setting.at("max_pixels")), float(setting.at("scale")));
        },
    .cpu = {{.solve =
                 [](const DisplacementProblem& p) {
                   DisplacedMesh mesh{cpu::displacement_factors(p), {}};
                   for (const dvec3& c : cpu::displaced_corners(p, mesh.factors))
                     mesh.corners.emplace_back(c);
                   return mesh;
                 }}},
    .gpu = {{.solve = [](gpu::Context& context,
                         const DisplacementProblem& p) { return gpu::displace(context, p); }}},
    .distance = distance,
    .tolerance = 128 * 0x1p-24 * 8,
    .why = "of places up to 8 m: three interpolations of up to four roundings each, and of a "
           "height whose place in the map is off by as much, times slopes of less than 0.1 a texel "
           "of 128; factors may differ where an error is within 0.002 px of the limit",
    .chart_axes = {"max_pixels"},
});

/// Largest distance in pixels between a cut mesh and the surface, over the lines of the lattice of
/// 32 parts that cross its triangles' edges.
double screen_error(const DisplacementProblem& p, const std::vector<uvec4>& factors) {
  double worst = 0;
  for (std::size_t i = 0; i < factors.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const auto errors = cpu::edge_errors(p, p.corners[3 * i + std::size_t((k + 1) % 3)],
                                           p.corners[3 * i + std::size_t((k + 2) % 3)]);
      worst = std::max(worst, errors[std::size_t(std::lround(std::log2(factors[i][k])))]);
    }
  return worst;
}

double triangles(const std::vector<uvec4>& factors) {
  double count = 0;
  for (const uvec4& f : factors) count += f.w * f.w;
  return count;
}

ChartData adaptive_against_uniform(gpu::Context& context) {
  Series adaptive{"as the picture needs", {}}, uniform{"the same everywhere", {}};
  double over = 0;
  DisplacementProblem p = hills(12, 1, 0.4f);
  for (const float limit : {8.0f, 4.0f, 2.0f, 1.0f, 0.5f}) {
    p.max_pixels = limit;
    const DisplacedMesh mesh = gpu::displace(context, p);
    const double error = screen_error(p, mesh.factors);
    adaptive.points.push_back({triangles(mesh.factors), error, short_number(limit) + " px"});
    over = std::max(over, error / limit);
  }
  for (const std::uint32_t parts : {1u, 2u, 4u, 8u, 16u}) {
    const std::vector<uvec4> factors(p.corners.size() / 3, uvec4(parts));
    uniform.points.push_back({triangles(factors), screen_error(p, factors), std::to_string(parts)});
  }
  return {
      .series = {adaptive, uniform},
      .assertions = {{"error over the limit that was asked for", over, 1.0}},
      .settings = {{"surface", "12x12 squares, hills of noise, 0.4 m"}, {"picture", "512x512 px"}}};
}

const Registration chart = register_chart({
    .name = "texture/displacement_error",
    .title = "Screen error of displaced triangles against their number",
    .x = {.label = "triangles", .unit = "1"},
    .y = {.label = "largest error on the screen", .unit = "px"},
    .produce = adaptive_against_uniform,
});

}  // namespace
}  // namespace parity
