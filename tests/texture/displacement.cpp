#include "cpu_reference/texture/displacement.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <span>

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

DisplacementCorner middle(const DisplacementCorner& a, const DisplacementCorner& b) {
  return {0.5f * (a.position + b.position), 0.5f * (a.normal + b.normal), 0.5f * (a.uv + b.uv)};
}

/// Factors are equal, or those that differ hang on a line whose error is near the limit: an edge on
/// itself, the inside on the edges and on the lines from corners to the middles of edges.
bool factors_agree(const DisplacementProblem& p, std::size_t triangle, const uvec4& got,
                   const uvec4& want) {
  bool inside_is_near_a_tie = false;
  for (std::size_t k = 0; k < 3; ++k) {
    const DisplacementCorner& corner = p.corners[3 * triangle + k];
    const DisplacementCorner& a = p.corners[3 * triangle + (k + 1) % 3];
    const DisplacementCorner& b = p.corners[3 * triangle + (k + 2) % 3];
    const std::uint32_t most = std::max(got.w, want.w);
    const auto edge = cpu::edge_errors(p, a, b);
    const auto across = cpu::edge_errors(p, corner, middle(a, b));
    const auto e = glm::length_t(k);
    if (got[e] != want[e] && !is_near_a_tie(p, edge, std::max(got[e], want[e]))) return false;
    inside_is_near_a_tie |= is_near_a_tie(p, edge, most) || is_near_a_tie(p, across, most);
  }
  return got.w == want.w || inside_is_near_a_tie;
}

/// Factors may differ where an error is within rounding of the limit; for the factors that there
/// are, every corner must be where it belongs.
double distance(const DisplacementProblem& p, const DisplacedMesh& got, const DisplacedMesh& want) {
  for (std::size_t i = 0; i < want.factors.size(); ++i)
    if (!factors_agree(p, i, got.factors[i], want.factors[i]))
      return std::numeric_limits<double>::infinity();
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

/// The hills themselves: heights bilinear between texels' centres, by the formula.
dvec3 surface_at(const DisplacementProblem& p, dvec2 uv) {
  const dvec2 place = uv * 128.0 - 0.5, cell = glm::floor(place), share = place - cell;
  const auto texel = [&](int i, int j) {
    const ivec2 at = (ivec2(cell) + ivec2(i, j) + 128) % 128;
    return p.heights(at.x, at.y).x / 255.0;
  };
  const double height = glm::mix(glm::mix(texel(0, 0), texel(1, 0), share.x),
                                 glm::mix(texel(0, 1), texel(1, 1), share.x), share.y);
  const dvec2 floor = (uv * 128.0 - 0.5) / 127.0;
  return {4 * floor.x - 2, double(p.scale) * height, -1 - 6 * floor.y};
}

/// From the first texel's centre to the last one's, as `inside_the_map` has it.
dvec2 uv_of(dvec3 point) {
  return (0.5 + 127.0 * dvec2((point.x + 2) / 4, (-1 - point.z) / 6)) / 128.0;
}

/// Without the cliff where the map repeats: no mesh follows it.
DisplacementProblem inside_the_map(DisplacementProblem p) {
  for (DisplacementCorner& corner : p.corners) corner.uv = (0.5f + 127.0f * corner.uv) / 128.0f;
  return p;
}

/// From (0, 1, 0) along -z, 256 pixels to the middle.
dvec2 pixel_of(dvec3 point) { return 256.0 * dvec2(point.x, 1 - point.y) / -point.z; }

/// Pixels between a point of a flat triangle, by its barycentric coordinates, and the hill above or
/// below it.
double off_screen(const DisplacementProblem& p, const dvec3 (&corners)[3], dvec3 b) {
  const dvec3 flat = b.x * corners[0] + b.y * corners[1] + b.z * corners[2];
  return glm::distance(pixel_of(flat), pixel_of(surface_at(p, uv_of(flat))));
}

/// Largest distance in pixels between the hills and a cut mesh, at 45 places of each small
/// triangle.
double inside_error(const DisplacementProblem& p, std::span<const dvec3> corners) {
  constexpr int parts = 8;
  double worst = 0;
  for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
    const dvec3 triangle[3] = {corners[i], corners[i + 1], corners[i + 2]};
    for (int a = 0; a <= parts; ++a)
      for (int b = 0; a + b <= parts; ++b)
        worst =
            std::max(worst, off_screen(p, triangle, dvec3(a, b, parts - a - b) / double(parts)));
  }
  return worst;
}

/// Largest distance in pixels between the hills and the straight pieces of an edge, at the 32
/// places that the limit is promised for.
double edge_error(const DisplacementProblem& p, const DisplacementCorner& from,
                  const DisplacementCorner& to, std::uint32_t parts) {
  const int length = 32 / int(parts);
  const auto at = [&](int step) {
    return surface_at(p, glm::mix(dvec2(from.uv), dvec2(to.uv), step / 32.0));
  };
  double worst = 0;
  for (int place = 0; place < 32; ++place) {
    const int begin = place / length * length;
    const dvec3 ends[3] = {at(begin), at(begin + length), dvec3(0)};
    const double share = double(place - begin) / length;
    worst = std::max(worst, off_screen(p, ends, {1 - share, share, 0}));
  }
  return worst;
}

/// Calls visit(from, to, parts) for each edge of each triangle before it is cut.
template <typename Visit>
void visit_edges(const DisplacementProblem& p, const std::vector<uvec4>& factors,
                 const Visit& visit) {
  for (std::size_t i = 0; i < factors.size(); ++i)
    for (int k = 0; k < 3; ++k)
      visit(p.corners[3 * i + std::size_t((k + 1) % 3)],
            p.corners[3 * i + std::size_t((k + 2) % 3)], factors[i][k]);
}

TEST(Displacement, CutsEdgesIntoAsFewPiecesAsTheLimitAllows) {
  for (const float limit : {6.0f, 2.0f, 0.7f}) {
    const DisplacementProblem p = inside_the_map(hills(6, limit, 0.4f));
    std::set<std::uint32_t> kinds;
    visit_edges(p, cpu::displacement_factors(p),
                [&](const auto& from, const auto& to, std::uint32_t parts) {
                  kinds.insert(parts);
                  // Places are floats: 2^-24 of 3 m, 256 pixels a metre, near the eye.
                  const double rounding = 4 * 256 * 3 * 0x1p-24;
                  if (parts < 32) {
                    EXPECT_LE(edge_error(p, from, to, parts), double(limit) + rounding);
                  }
                  if (parts > 1) {
                    EXPECT_GT(edge_error(p, from, to, parts / 2), double(limit) - rounding);
                  }
                });
    EXPECT_GT(kinds.size(), 2u) << "the test needs edges that differ";
  }
}

TEST(Displacement, PutsEveryCornerOnTheHills) {
  const DisplacementProblem p = inside_the_map(hills(6, 1, 0.4f));
  for (const dvec3& corner : cpu::displaced_corners(p, cpu::displacement_factors(p)))
    // Texture coordinates are floats: 2^-24 of a map of 128 texels whose slope is below 0.4 a
    // texel.
    EXPECT_LT(glm::distance(corner, surface_at(p, uv_of(corner))), 4 * 128 * 0.4 * 0x1p-24);
}

double triangles(const std::vector<uvec4>& factors) {
  double count = 0;
  for (const uvec4& f : factors) count += f.w * f.w;
  return count;
}

ChartData adaptive_against_uniform(gpu::Context& context) {
  Series adaptive{"as the picture needs, edges", {}}, inside{"as the picture needs, inside", {}};
  Series uniform{"the same everywhere, edges", {}};
  Series uniform_inside{"the same everywhere, inside", {}};
  double over = 0, inside_over = 0;
  const auto worst_edge = [](const DisplacementProblem& p, const std::vector<uvec4>& factors) {
    double worst = 0;
    visit_edges(p, factors, [&](const auto& from, const auto& to, std::uint32_t parts) {
      worst = std::max(worst, edge_error(p, from, to, parts));
    });
    return worst;
  };
  DisplacementProblem p = inside_the_map(hills(12, 1, 0.4f));
  for (const float limit : {8.0f, 4.0f, 2.0f, 1.0f, 0.5f}) {
    p.max_pixels = limit;
    const DisplacedMesh mesh = gpu::displace(context, p);
    const double count = triangles(mesh.factors);
    adaptive.points.push_back({count, worst_edge(p, mesh.factors), short_number(limit) + " px"});
    inside.points.push_back(
        {count, inside_error(p, std::vector<dvec3>(mesh.corners.begin(), mesh.corners.end()))});
    over = std::max(over, adaptive.points.back().y / limit);
    inside_over = std::max(inside_over, inside.points.back().y / limit);
  }
  for (const std::uint32_t parts : {1u, 2u, 4u, 8u, 16u}) {
    const std::vector<uvec4> factors(p.corners.size() / 3, uvec4(parts));
    const double count = triangles(factors);
    uniform.points.push_back({count, worst_edge(p, factors), std::to_string(parts)});
    uniform_inside.points.push_back({count, inside_error(p, cpu::displaced_corners(p, factors))});
  }
  return {.series = {adaptive, inside, uniform, uniform_inside},
          .assertions = {{"error on edges over the limit that was asked for", over, 1.0}},
          .settings = {{"surface", "12x12 squares, hills of noise, 0.4 m"},
                       {"picture", "512x512 px"},
                       {"inside, where nothing is promised, over the limit",
                        short_number(std::round(10 * inside_over) / 10)}}};
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
