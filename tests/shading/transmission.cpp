#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cpu_reference/shading/behind.h"
#include "cpu_reference/shading/metallic_roughness.h"
#include "cpu_reference/shading/prefilter.h"
#include "geometry/random.h"
#include "tests/chart.h"

/// Transmission as rasterisers approximate it, beside light that is followed through the glass.
namespace parity {
namespace {

constexpr double glass_index = 1.5;

/// A bright band along the horizon that fades upwards and downwards, and a lamp.
Grid<vec4> sky() {
  Grid<vec4> picture{128, 64};
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 128; ++x) {
      const double up = (32 - y - 0.5) / 32, turn = 2 * std::numbers::pi * (x + 0.5) / 128;
      picture(x, y) = vec4(vec3(float(0.3 + std::exp(-4 * up * up) + 0.2 * std::sin(2 * turn))), 1);
    }
  return picture;
}

dvec3 uniform_in_lobe(Random& random, const dvec3& n, double alpha) {
  // Slopes of GGX: tan^2 = alpha^2 u / (1 - u).
  const double u = random.uniform(0.0f, 1.0f), phi = random.uniform(0.0f, 6.2831853f);
  const double tangent = alpha * std::sqrt(u / (1 - u + 1e-9));
  const dvec3 aside = std::abs(n.x) < 0.5 ? dvec3(1, 0, 0) : dvec3(0, 1, 0);
  const dvec3 t = glm::normalize(glm::cross(aside, n));
  return glm::normalize(n + tangent * (std::cos(phi) * t + std::sin(phi) * glm::cross(n, t)));
}

double smith(double cosine, double alpha) {
  const double tangent2 = 1 / (cosine * cosine) - 1;
  return 2 / (1 + std::sqrt(1 + alpha * alpha * tangent2));
}

/// A ray at a rough border of glass: goes on into the other side or back, with the share of light
/// that microfacets let through. Source: Walter et al. 2007.
struct Border {
  double alpha = 0;  ///< 0: smooth

  /// @param n  on the ray's side; eta is the index there over that beyond.
  double cross(dvec3& direction, const dvec3& n, double eta, Random& random, bool& passes) const {
    const dvec3 from = -direction;
    const dvec3 m = alpha > 0 ? uniform_in_lobe(random, n, alpha) : n;
    const double cosine = glm::dot(from, m), n_from = glm::dot(from, n);
    if (cosine <= 0) return 0;
    const double sine2 = eta * eta * (1 - cosine * cosine);
    double reflectance = 1, inside = 0;
    if (sine2 < 1) {
      inside = std::sqrt(1 - sine2);
      const double s = (eta * cosine - inside) / (eta * cosine + inside);
      const double p = (cosine - eta * inside) / (cosine + eta * inside);
      reflectance = 0.5 * (s * s + p * p);
    }
    passes = random.uniform(0.0f, 1.0f) >= reflectance;
    direction = passes ? (eta * cosine - inside) * m - eta * from : 2 * cosine * m - from;
    direction = glm::normalize(direction);
    const double n_to = glm::dot(direction, n) * (passes ? -1 : 1);
    if (n_to <= 0) return 0;
    if (alpha == 0) return 1;
    return cosine * smith(n_from, alpha) * smith(n_to, alpha) / (n_from * glm::dot(m, n));
  }
};

enum class Shape { slab, sphere };

/// Radiance that comes along `direction` from glass hit where its normal is +z.
double followed(const EnvironmentMap& light, Shape shape, double alpha, dvec3 direction,
                Random& random) {
  const Border border{alpha};
  dvec3 n{0, 0, 1};  // outwards, where the ray is; on a sphere that is the place too
  double weight = 1;
  bool is_inside = false;
  for (int bounce = 0; bounce < 32; ++bounce) {
    bool passes = false;
    const double eta = is_inside ? glass_index : 1 / glass_index;
    weight *= border.cross(direction, is_inside ? -n : n, eta, random, passes);
    if (weight == 0) return 0;
    is_inside ^= passes;
    if (!is_inside) return weight * double(radiance_toward(light, direction).x);
    n = shape == Shape::slab ? dvec3(0, 0, direction.z > 0 ? 1 : -1)
                             : glm::normalize(n - 2 * glm::dot(n, direction) * direction);
  }
  return 0;
}

double exact(const EnvironmentMap& light, Shape shape, double roughness, const dvec3& to_eye) {
  Random random{7};
  constexpr int count = 20000;
  const double alpha = roughness > 0.05 ? roughness * roughness : 0;
  double sum = 0;
  for (int i = 0; i < count; ++i) sum += followed(light, shape, alpha, -to_eye, random);
  return sum / count;
}

/// What the renderers show of glass that has only the surroundings behind it: their picture of what
/// is opaque there is empty.
double approximated(const EnvironmentLight& light, bool thick, double roughness,
                    const dvec3& to_eye) {
  Material glass;
  glass.metallic = 0;
  glass.roughness = float(roughness);
  glass.transmission.factor = 1;
  glass.transmission.thickness = thick ? 1.0f : 0.0f;
  cpu::ShadingScene scene;
  scene.eye = 10.0 * to_eye;
  scene.around.light = &light;
  static const BehindPicture nothing{.levels = {Grid<vec4>{1, 1, vec4(0)}}};
  scene.around.behind = &nothing;
  cpu::ShadingPoint<double> point;
  namespace input = cpu::shading_input;
  for (std::size_t i = input::color; i < input::count; ++i) point.inputs[i] = 1;
  for (const std::size_t map_input : {input::normal_texture, input::coat_normal_texture})
    point.inputs[map_input] = point.inputs[map_input + 1] = 0.5;
  point.inputs[input::normal + 2] = 1;
  const cpu::Shaded<double> shaded = cpu::shade(glass, scene, point);
  return shaded.rgb[0];
}

dvec3 to_eye_at(double degrees) {
  const double a = degrees * std::numbers::pi / 180;
  return {0.6 * std::sin(a), 0.8 * std::sin(a), std::cos(a)};
}

struct Case {
  const char* name;
  bool thick;
  Shape shape;
  double roughness;
};

const std::vector<Case>& cases() {
  static const std::vector<Case> all{
      {"thin wall, smooth", false, Shape::slab, 0.045},
      {"thin wall, roughness 0.4", false, Shape::slab, 0.4},
      {"volume beside a sphere, smooth", true, Shape::sphere, 0.045},
      {"volume beside a sphere, roughness 0.4", true, Shape::sphere, 0.4},
      {"volume beside a slab, smooth", true, Shape::slab, 0.045}};
  return all;
}

struct Light {
  EnvironmentMap map = environment_map(sky(), 64);
  EnvironmentLight light = cpu::prefilter(map, 64);
};

ChartData errors(gpu::Context&) {
  const Light sky_light;
  ChartData data;
  for (const Case& c : cases()) {
    Series series{c.name, {}};
    for (double degrees = 0; degrees <= 80; degrees += 8) {
      const dvec3 to_eye = to_eye_at(degrees);
      const double want = exact(sky_light.map, c.shape, c.roughness, to_eye);
      const double got = approximated(sky_light.light, c.thick, c.roughness, to_eye);
      series.points.push_back({degrees, std::abs(got - want) / want});
    }
    data.series.push_back(series);
  }
  data.settings = {{"glass", "index 1.5, clear"}, {"exact", "20,000 paths through both borders"}};
  return data;
}

const Registration chart = register_chart({
    .name = "shading/transmission",
    .title =
        "Light of the surroundings through glass by one lookup, beside paths through both sides",
    .x = {.label = "angle of view", .unit = "degrees", .logarithmic = false},
    .y = {.label = "relative error", .logarithmic = false},
    .produce = errors,
});

TEST(Transmission, PathsThroughASmoothSlabAddUpToItsSeries) {
  // Light from everywhere alike comes back and through: 1 in all.
  EnvironmentMap white = environment_map(Grid<vec4>{8, 4, vec4(1)}, 8);
  for (const Shape shape : {Shape::slab, Shape::sphere})
    EXPECT_NEAR(exact(white, shape, 0.0, to_eye_at(50)), 1, 1e-6);
  // From below only: (1 - R) / (1 + R) passes, R the reflectance of one side.
  Grid<vec4> half{64, 32, vec4(0, 0, 0, 1)};
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 64; ++x) half(x, y) = vec4(x > 15 && x < 48 ? 1.0f : 0.0f);
  const double r = 0.04;
  // 20,000 paths: four standard deviations of a coin of that bias.
  const double passed = (1 - r) / (1 + r);
  EXPECT_NEAR(exact(environment_map(half, 64), Shape::slab, 0.0, dvec3(0, 0, 1)), passed,
              4 * std::sqrt(passed * (1 - passed) / 20000));
}

TEST(Transmission, OneLookupIsWithinWhatASecondBorderTakes) {
  const Light sky_light;
  // Straight through a thin wall: one border instead of two, R = 0.04 of the light, and 1 % for
  // paths and the tables.
  const double want = exact(sky_light.map, Shape::slab, 0.0, dvec3(0, 0, 1));
  const double got = approximated(sky_light.light, false, 0.045, dvec3(0, 0, 1));
  EXPECT_NEAR(got / want, 1, 0.05);
}

/// Glass of 1 m, a slab whose front is at z = 0 or a ball about z = -0.5, between an eye at z = 10
/// and a wall. Where on the wall (x) a ray from the eye ends that meets the glass at x.
struct WallBehind {
  Shape shape = Shape::slab;
  double wall = -1.5;
  dvec3 eye{0, 0, 10};

  dvec3 normal_at(double x) const {
    return shape == Shape::slab ? dvec3(0, 0, 1) : dvec3(2 * x, 0, std::sqrt(1 - 4 * x * x));
  }
  dvec3 place_at(double x) const {
    return shape == Shape::slab ? dvec3(x, 0, 0) : 0.5 * normal_at(x) - dvec3(0, 0, 0.5);
  }
  double on_wall(const dvec3& p, const dvec3& way) const {
    return p.x + way.x / way.z * (wall - p.z);
  }
  static dvec3 refracted(const dvec3& way, const dvec3& n, double eta) {
    const double cosine = -glm::dot(way, n);
    return eta * way + (eta * cosine - std::sqrt(1 - eta * eta * (1 - cosine * cosine))) * n;
  }

  double followed(double x) const {
    const dvec3 n = normal_at(x), from = place_at(x);
    const dvec3 inside = refracted(glm::normalize(from - eye), n, 1 / glass_index);
    const double way = shape == Shape::slab ? -1 / inside.z : -glm::dot(inside, n);
    const dvec3 out = from + inside * way;
    const dvec3 back = shape == Shape::slab ? n : 2.0 * (dvec3(0, 0, -0.5) - out);
    return on_wall(out, refracted(inside, back, glass_index));
  }
  double straight(double x) const {
    return on_wall(place_at(x), glm::normalize(place_at(x) - eye));
  }
  /// The wall's own x as the colour of a picture from the eye, read where the refracted ray leaves.
  double by_picture(double x) const {
    static const BehindPicture picture = picture_of_wall(wall - eye.z);
    const dvec3 from = place_at(x);
    const dvec3 inside = refracted(glm::normalize(from - eye), normal_at(x), 1 / glass_index);
    const dvec3 p = from + inside - eye;
    return cpu::picture_behind<double>(picture, dvec3(0), {p.x, p.y, p.z}, 0.0)[0] - 8;
  }
  /// Positions relative to the eye; colours are above 0.
  static BehindPicture picture_of_wall(double z) {
    constexpr int side = 256;
    const double half = 0.3;  // tangent of half of the view
    Grid<vec4> colors{side, 2};
    for (int y = 0; y < 2; ++y)
      for (int i = 0; i < side; ++i)
        colors(i, y) = vec4(float(((i + 0.5) * 2 / side - 1) * half * -z + 8), 0, 0, 1);
    dmat4 clip(1.0);
    clip[0][0] = clip[1][1] = 1 / half;
    clip[2][3] = -1;
    clip[3][3] = 0;
    return {{colors}, clip};
  }
};

ChartData places(gpu::Context&) {
  ChartData data;
  for (const Shape shape : {Shape::slab, Shape::sphere}) {
    const WallBehind glass{.shape = shape};
    const std::string name = shape == Shape::slab ? "slab" : "ball";
    Series straight{name + ", unrefracted", {}}, picture{name + ", by the picture", {}};
    for (double x = 0.02; x < 0.47; x += 0.03) {
      const double want = glass.followed(x);
      straight.points.push_back({x, std::abs(glass.straight(x) - want)});
      picture.points.push_back({x, std::abs(glass.by_picture(x) - want)});
    }
    data.series.push_back(straight);
    data.series.push_back(picture);
  }
  data.settings = {
      {"glass", "index 1.5, 1 m thick"}, {"eye", "10 m before it"}, {"wall", "0.5 m behind it"}};
  return data;
}

const Registration places_chart = register_chart({
    .name = "shading/transmission_places",
    .title = "How far from the right place glass shows a wall behind it",
    .x = {.label = "place on the glass, from its middle", .unit = "m", .logarithmic = false},
    .y = {.label = "distance on the wall", .unit = "m"},
    .produce = places,
});

TEST(Transmission, ThroughASlabThePictureShowsNearlyTheRightPlace) {
  const WallBehind slab{.shape = Shape::slab, .wall = -1};
  for (const double x : {0.1, 0.3, 0.45}) {
    // On a wall that touches the slab the ray leaves on it: but for its thickness along the ray,
    // the place is exact, to what a bilinear ramp of floats is.
    const double slant = 1 - std::sqrt(1 - std::pow(x / 10 / glass_index, 2));
    EXPECT_NEAR(slab.by_picture(x), slab.followed(x), slant + 1e-5);
    EXPECT_GT(std::abs(slab.straight(x) - slab.followed(x)),
              5 * std::abs(slab.by_picture(x) - slab.followed(x)));
  }
}

}  // namespace
}  // namespace parity
