#include "gpu/shading/ambient_occlusion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cpu_reference/shading/ambient_occlusion.h"
#include "geometry/random.h"
#include "tests/chart.h"
#include "tests/stage.h"

/// The share of the sky from a picture's distances, beside rays and closed forms.
namespace parity {

auto fields_of(const OcclusionProblem*) {
  return std::tuple{&OcclusionProblem::distances,    &OcclusionProblem::slope,
                    &OcclusionProblem::orthographic, &OcclusionProblem::radius,
                    &OcclusionProblem::slices,       &OcclusionProblem::parts};
}

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Ray {
  dvec3 origin{0.0};
  dvec3 way{0.0, 0.0, -1.0};
};

struct Ball {
  dvec3 center{0.0};
  double radius = 1;
};

struct HalfSpace {
  dvec3 normal{0.0};  ///< outwards
  double offset = 0;  ///< dot(normal, p) of its plane
};

/// What is solid, in the view's space: planes, balls, and blocks that are intersections of planes.
struct Solids {
  std::vector<HalfSpace> floors;
  std::vector<Ball> balls;
  std::vector<std::vector<HalfSpace>> blocks;
};

struct Hit {
  double distance = infinity;
  dvec3 normal{0.0};
};

void keep(Hit& hit, double distance, const dvec3& normal) {
  if (distance > 1e-9 && distance < hit.distance) hit = {distance, normal};
}

/// Enters where the last of the planes is passed that face the ray.
void hit_block(const std::vector<HalfSpace>& planes, const Ray& ray, Hit& hit) {
  double enter = -infinity, leave = infinity;
  dvec3 normal{0.0};
  for (const HalfSpace& plane : planes) {
    const double slope = glm::dot(plane.normal, ray.way);
    const double over = glm::dot(plane.normal, ray.origin) - plane.offset;
    if (slope == 0 && over > 0) return;
    const double at = -over / slope;
    if (slope < 0 && at > enter) {
      enter = at;
      normal = plane.normal;
    }
    if (slope > 0) leave = std::min(leave, at);
  }
  if (enter < leave) keep(hit, enter, normal);
}

Hit first_hit(const Solids& solids, const Ray& ray) {
  Hit hit;
  for (const HalfSpace& floor : solids.floors) hit_block({floor}, ray, hit);
  for (const std::vector<HalfSpace>& block : solids.blocks) hit_block(block, ray, hit);
  for (const Ball& ball : solids.balls) {
    const dvec3 to = ball.center - ray.origin;
    const double middle = glm::dot(to, ray.way);
    const double inside = ball.radius * ball.radius - glm::dot(to, to) + middle * middle;
    if (inside < 0) continue;
    const double at = middle - std::sqrt(inside);
    keep(hit, at, (ray.origin + at * ray.way - ball.center) / ball.radius);
  }
  return hit;
}

std::vector<HalfSpace> block(const dvec3& low, const dvec3& high) {
  std::vector<HalfSpace> planes;
  for (int axis = 0; axis < 3; ++axis) {
    dvec3 n{0.0};
    n[axis] = 1;
    planes.push_back({n, high[axis]});
    planes.push_back({-n, -low[axis]});
  }
  return planes;
}

Ray ray_through(const OcclusionProblem& p, double x, double y) {
  const dvec3 side{(2 * x / p.distances.width() - 1) * double(p.slope.x),
                   (1 - 2 * y / p.distances.height()) * double(p.slope.y), 0.0};
  if (p.orthographic) return {side, {0, 0, -1}};
  return {dvec3(0.0), glm::normalize(side + dvec3(0, 0, -1))};
}

void look(OcclusionProblem& p, const Solids& solids) {
  for (int y = 0; y < p.distances.height(); ++y)
    for (int x = 0; x < p.distances.width(); ++x) {
      const Ray ray = ray_through(p, x + 0.5, y + 0.5);
      const Hit hit = first_hit(solids, ray);
      p.distances(x, y) = float(-hit.distance * ray.way.z);
    }
}

enum Kind { plane_kind, corner_kind, dome_kind, room_kind };

Solids solids_of(int kind) {
  const dvec3 up = glm::normalize(dvec3(0, 1, 0.6));
  Solids s;
  if (kind == plane_kind) s.floors = {{up, -3}};
  if (kind == corner_kind) s.floors = {{{0, 1, 0}, -1}, {{0, 0, 1}, -6}};
  if (kind == dome_kind) {
    s.floors = {{{0, 0, 1}, -6}};
    s.balls = {{{0, 0, -6}, 1.1}};
  }
  if (kind == room_kind) {
    s.floors = {{{0, 1, 0}, -1.5}, {{0, 0, 1}, -8}, {{1, 0, 0}, -2.5}};
    s.balls = {{{0.6, -0.9, -6}, 0.6}};
    s.blocks = {block({-1.9, -1.5, -7.4}, {-0.8, 0.3, -6.4})};
  }
  return s;
}

OcclusionProblem problem_of(int kind, int width, int height, bool orthographic, int order,
                            int steps) {
  OcclusionProblem p;
  p.distances = Grid<float>{width, height};
  p.orthographic = orthographic;
  const float half = orthographic ? 2.5f : 0.45f;
  p.slope = {half, half * float(height) / float(width)};
  p.radius = 1.5f;
  p.slices = slice_directions(order);
  p.parts = slice_parts(steps);
  look(p, solids_of(kind));
  return p;
}

OcclusionProblem problem_at(const Setting& setting) {
  return problem_of(setting.count("scene"), setting.count("width"), setting.count("height"),
                    setting.count("orthographic") == 1, setting.count("order"),
                    setting.count("steps"));
}

dvec3 cosine_direction(const dvec3& n, double u, double v) {
  const dvec3 aside = std::abs(n.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
  const dvec3 t = glm::normalize(glm::cross(aside, n));
  const double r = std::sqrt(u), phi = 2 * std::numbers::pi * v;
  return r * std::cos(phi) * t + r * std::sin(phi) * glm::cross(n, t) + std::sqrt(1 - u) * n;
}

/// By rays to the middles of side^2 parts of the hemisphere.
double seen_by_rays(const Solids& solids, const dvec3& place, const dvec3& n, double radius,
                    int side) {
  const double fade = radius * double(occlusion_fade);
  double open = 0;
  for (int i = 0; i < side * side; ++i) {
    const dvec3 way = cosine_direction(n, (i / side + 0.5) / side, (i % side + 0.5) / side);
    const double d = first_hit(solids, {place + 1e-6 * n, way}).distance;
    open += 1 - std::clamp((radius * radius - d * d) / (radius * radius - fade * fade), 0.0, 1.0);
  }
  return open / (side * side);
}

/// Root mean square over some of the pixels.
double error_of(const OcclusionProblem& p, int kind, const Grid<double>& got) {
  const Solids solids = solids_of(kind);
  double sum = 0;
  int count = 0;
  for (int y = 2; y < got.height(); y += 5)
    for (int x = 2; x < got.width(); x += 5) {
      const Ray ray = ray_through(p, x + 0.5, y + 0.5);
      const Hit hit = first_hit(solids, ray);
      if (hit.distance == infinity) continue;
      const dvec3 place = ray.origin + hit.distance * ray.way;
      const double want = seen_by_rays(solids, place, hit.normal, double(p.radius), 24);
      sum += (got(x, y) - want) * (got(x, y) - want);
      ++count;
    }
  return count == 0 ? 0 : std::sqrt(sum / count);
}

Grid<double> widened(const Grid<float>& values) {
  Grid<double> result(values.width(), values.height());
  std::copy(values.begin(), values.end(), result.begin());
  return result;
}

/// Largest |p| over the side of a pixel there.
double pixels_away(const OcclusionProblem& p) {
  const double pixel = 2 * double(p.slope.x) / p.distances.width();
  if (!p.orthographic) return std::sqrt(1 + 2 * double(glm::dot(p.slope, p.slope))) / pixel;
  double far = double(p.slope.x + p.slope.y);
  for (const float d : p.distances)
    if (std::isfinite(d)) far = std::max(far, double(d));
  return far / pixel;
}

double tolerance_of(const OcclusionProblem& p) { return 16 * 8 * 0x1p-24 * pixels_away(p) + 1e-6; }

const Registration registration = register_stage<OcclusionProblem, Grid<double>>({
    .name = "shading/ambient_occlusion",
    .title = "Ambient occlusion: horizons in slices through the view, from a picture's distances",
    .source = "notes 6.2; Jimenez, Wu, Pesce & Jarabo 2016",
    .axes = {{.name = "order", .low = 1, .high = 5, .standard = 2, .whole = true},
             {.name = "steps", .low = 1, .high = 24, .standard = 8, .whole = true},
             {.name = "width", .unit = "px", .low = 1, .high = 131, .standard = 67, .whole = true},
             {.name = "height", .unit = "px", .low = 1, .high = 97, .standard = 51, .whole = true},
             {.name = "scene",
              .low = plane_kind,
              .high = room_kind,
              .standard = room_kind,
              .whole = true,
              .each = true},
             {.name = "orthographic", .low = 0, .high = 1, .standard = 0, .whole = true}},
    .problem = problem_at,
    .cpu = {{.solve = [](const OcclusionProblem& p) { return cpu::ambient_occlusion(p); }}},
    .gpu = {{.solve =
                 [](gpu::Context& context, const OcclusionProblem& p) {
                   return widened(gpu::ambient_occlusion(context, p));
                 }}},
    .distance =
        [](const Grid<double>& got, const Grid<double>& want) {
          double worst = 0;
          for (std::size_t i = 0; i < want.size(); ++i)
            worst = std::max(worst, std::abs(got.values()[i] - want.values()[i]));
          return worst;
        },
    .tolerance = tolerance_of,
    .why =
        "positions are off by 4 2^-24 |p| each, differences of neighbours by twice that over the "
        "side of a pixel; cosines of horizons follow once, normals three times, in both sums; "
        "2e-8 for the arc cosine",
});

TEST(AmbientOcclusion, APlaneSeesAllOfTheSky) {
  for (const bool orthographic : {false, true}) {
    const OcclusionProblem p = problem_of(plane_kind, 61, 43, orthographic, 3, 8);
    for (const double open : cpu::ambient_occlusion(p)) EXPECT_NEAR(open, 1, tolerance_of(p));
  }
}

TEST(AmbientOcclusion, AnArcIsItsIntegral) {
  Random random{3};
  for (int i = 0; i < 50; ++i) {
    const double normal = random.uniform(-1.5f, 1.5f), quarter = std::numbers::pi / 2;
    const double ahead = (quarter + normal) * double(random.uniform(0.0f, 1.0f));
    const double back = (quarter - normal) * double(random.uniform(0.0f, 1.0f));
    double sum = 0;
    constexpr int count = 2000;
    for (int k = 0; k < count; ++k) {
      const double t = -back + (ahead + back) * (k + 0.5) / count;
      sum += std::cos(t - normal) * std::abs(std::sin(t)) * (ahead + back) / count;
    }
    EXPECT_NEAR(cpu::open_arc(normal, ahead, back), sum, 1e-5);
  }
}

/// Seen straight down from 1000 m above the floor; one pixel is 1 m.
OcclusionProblem seen_from_above(int width, int height, int order, const auto& height_at) {
  OcclusionProblem p;
  p.distances = Grid<float>{width, height};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      p.distances(x, y) = float(1000 - height_at(x - width / 2, y - height / 2));
  p.slope = 0.5f * vec2(float(width), float(height));
  p.orthographic = true;
  p.radius = 10000;
  p.slices = slice_directions(order);
  for (int i = 1; i <= width / 2; ++i) p.parts.push_back(float(i) / p.radius);
  return p;
}

/// (1 + cos horizon) / 2.
double beside_wall(double distance, double height) {
  return 0.5 * (1 + distance / std::hypot(distance, height));
}

TEST(AmbientOcclusion, BesideAWallItIsHalfOfOnePlusTheCosineOfTheHorizon) {
  constexpr int order = 4;
  for (const double height : {10.0, 40.0}) {
    // Texels from x = 0 on are wall.
    const OcclusionProblem p =
        seen_from_above(121, 121, order, [&](int x, int) { return x >= 0 ? height : 0.0; });
    const Grid<double> open = cpu::ambient_occlusion(p);
    for (const int d : {10, 20}) {
      // The wall's first texel along a slice is at most `order` too far; what lies beyond the
      // picture (azimuths whose cosine is below c) hides nothing; 24 slices.
      const double c = std::cos(std::atan(60.0 / d)), hidden = height * c / d;
      const double unseen =
          std::asin(c) / std::numbers::pi * hidden * hidden / (1 + hidden * hidden);
      const double got = open(60 - d, 60);
      EXPECT_GE(got, beside_wall(d, height) - 3e-3) << height << ", " << d;
      EXPECT_LE(got, beside_wall(d + order - 1, height) + unseen + 3e-3) << height << ", " << d;
    }
  }
}

/// Of a floor beside half a ball on it: what one minus the view factor is.
double beside_dome(double distance, double radius) {
  const double h = distance / radius, root = std::sqrt(h * h - 1);
  return 1 - (std::atan(1 / root) - root / (h * h)) / std::numbers::pi;
}

TEST(AmbientOcclusion, BesideADomeItIsOneLessItsViewFactor) {
  constexpr double radius = 20;
  const OcclusionProblem p = seen_from_above(121, 121, 4, [](int x, int y) {
    return std::sqrt(std::max(0.0, radius * radius - x * x - y * y));
  });
  const Grid<double> open = cpu::ambient_occlusion(p);
  const Solids dome{{{{0, 0, 1}, 0}}, {{{0, 0, 0}, radius}}, {}};
  for (const int away : {24, 30, 45}) {
    const double want = beside_dome(away, radius);
    EXPECT_NEAR(seen_by_rays(dome, {double(away), 0, 0}, {0, 0, 1}, 1e6, 128), want, 2e-3);
    // A texel too near or too far, and slices that meet only the rim.
    const double slack = beside_dome(away + 1.0, radius) - beside_dome(away - 1.0, radius);
    EXPECT_NEAR(open(60 + away, 60), want, slack + 5e-3);
  }
}

TEST(AmbientOcclusion, WhatIsFartherThanTheRadiusHidesNothing) {
  OcclusionProblem p = seen_from_above(81, 81, 2, [](int x, int) { return x >= 0 ? 3.0 : 0.0; });
  p.radius = 8;
  p.parts = slice_parts(16);
  const Grid<double> open = cpu::ambient_occlusion(p);
  EXPECT_EQ(open(40 - 10, 40), 1);
  EXPECT_LT(open(40 - 1, 40), 0.8);
}

TEST(AmbientOcclusion, MoreSlicesAndStepsComeCloserToRays) {
  const auto error = [](int order, int steps) {
    const OcclusionProblem p = problem_of(corner_kind, 97, 73, false, order, steps);
    return error_of(p, corner_kind, cpu::ambient_occlusion(p));
  };
  const double few = error(1, 2), some = error(2, 6), many = error(4, 24);
  EXPECT_LT(some, 0.7 * few);
  EXPECT_LT(many, some);
  EXPECT_LT(many, 0.06);
}

TEST(AmbientOcclusion, RefusesARadiusOfNothing) {
  OcclusionProblem p = problem_of(plane_kind, 4, 4, false, 1, 1);
  p.radius = 0;
  EXPECT_THROW(cpu::ambient_occlusion(p), std::invalid_argument);
}

ChartData errors_by_samples(gpu::Context& context) {
  const std::array<const char*, 4> names{"plane", "corner", "dome", "room"};
  ChartData data;
  for (const int kind : {corner_kind, dome_kind, room_kind})
    for (const int order : {1, 2}) {
      Series series{
          std::string(names[std::size_t(kind)]) + ", " + std::to_string(4 * order) + " slices", {}};
      for (const int steps : {2, 4, 8, 16, 32}) {
        const OcclusionProblem p = problem_of(kind, 193, 145, false, order, steps);
        series.points.push_back({2.0 * double(p.slices.size()) * steps,
                                 error_of(p, kind, widened(gpu::ambient_occlusion(context, p)))});
      }
      data.series.push_back(series);
    }
  data.settings = {
      {"picture",
       "193 x 145; in the room a ball and a block, which are not as thick as is thought"},
      {"exact", "576 rays a pixel, also to what the picture does not show"}};
  return data;
}

const Registration chart = register_chart({
    .name = "shading/ambient_occlusion_error",
    .title = "Ambient occlusion from a picture's distances, beside rays",
    .x = {.label = "texels read a pixel"},
    .y = {.label = "root mean square error of the open share"},
    .produce = errors_by_samples,
});

/// A bar that floats `gap` over the floor, `width` wide and long without end, seen from above.
double bar_error(double width, double gap) {
  constexpr int side = 101;
  const double d = 5, thin = 0.5;
  const OcclusionProblem p = seen_from_above(side, side, 2, [&](int x, int) {
    return x >= d && x <= d + width * d ? gap * d + thin : 0.0;
  });
  const double got = cpu::ambient_occlusion(p)(side / 2, side / 2);
  const auto below = [](double height, double away) { return away / std::hypot(height, away); };
  const double hidden = 0.5 * (below(gap * d, d * (1 + width)) - below(gap * d + thin, d));
  return std::abs(got - (1 - hidden));
}

const Registration map = register_map({
    .name = "shading/ambient_occlusion_gap",
    .title = "Error beneath what floats: a bar is thought to reach down to the floor",
    .x = {.name = "width of the bar over its distance",
          .low = 0.1,
          .high = 5,
          .standard = 1,
          .logarithmic = true},
    .y = {.name = "gap beneath over its distance",
          .low = 0.05,
          .high = 5,
          .standard = 1,
          .logarithmic = true},
    .value_label = "error of the open share",
    .logarithmic = false,
    .border = 0.1,
    .columns = 12,
    .rows = 10,
    .value = [](gpu::Context&, double width, double gap) { return bar_error(width, gap); },
    .theory = {{"(1 - cos horizon of the gap) / 2 = 0.1",
                [](double width) { return 0.75 * (1 + width); }}},
});

}  // namespace
}  // namespace parity
