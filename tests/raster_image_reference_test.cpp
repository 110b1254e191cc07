#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "cpu_reference/raster/depth.h"
#include "cpu_reference/raster/edge_coverage.h"
#include "cpu_reference/raster/interpolate.h"
#include "cpu_reference/raster/painter.h"
#include "cpu_reference/raster/viewport.h"
#include "cpu_reference/transform/perspective.h"
#include "tests/raster/errata_depth.h"
#include "tests/raster/triangle_lists.h"

namespace parity {
namespace {

/// Triangles in front of a camera with a right-angled field of view, near 1 m, far 100 m.
struct View {
  std::vector<dvec3> points;  ///< m, view space, three a triangle
  TriangleList list;
};

View random_view(int size, int count, DepthMode mode, unsigned seed) {
  View view{{}, empty_list(size, size, 1)};
  const dmat4 clip_from_view =
      cpu::perspective(std::vector{ViewVolume{-1.0f, 1.0f, -1.0f, 1.0f, 1.0f, 100.0f}}, mode)[0];
  std::mt19937 random{seed};
  std::uniform_real_distribution<double> unit{-1.0, 1.0};
  for (int i = 0; i < count; ++i) {
    const double distance = 2.0 + 60.0 * std::abs(unit(random));
    const dvec3 center{distance * unit(random), distance * unit(random), -distance};
    vec4 clip[3];
    for (vec4& c : clip) {
      const dvec3 p = center + 0.45 * distance * dvec3(unit(random), unit(random), unit(random));
      view.points.push_back(p);
      c = vec4(clip_from_view * dvec4(p, 1.0));
    }
    add_triangle(view.list, clip[0], clip[1], clip[2]);
  }
  return view;
}

/// The point of a triangle that pixel (x, y) sees.
dvec3 seen_point(const View& view, std::uint32_t triangle, int x, int y) {
  const dvec3* p = &view.points[3 * triangle];
  const dvec3 ray{2.0 * (x + 0.5) / view.list.width - 1.0, 1.0 - 2.0 * (y + 0.5) / view.list.height,
                  -1.0};
  const dvec3 normal = glm::cross(p[1] - p[0], p[2] - p[0]);
  return ray * (glm::dot(normal, p[0]) / glm::dot(normal, ray));
}

// 1.3, 1.6: interpolation

TEST(RasterReference, PlanesGiveBarycentricsDepthAndWOfTheCorners) {
  const std::array<vec4, 3> clip{vec4(-1, -2, 0.5f, 4), vec4(3, 1, 2, 5), vec4(0, 1, 1.5f, 2)};
  const cpu::TrianglePlanes planes = cpu::triangle_planes(clip, 320, 200);
  const std::vector<dvec4> window = cpu::to_window(clip, 320, 200);
  for (int i = 0; i < 3; ++i) {
    const dvec4 p = window[std::size_t(i)];
    dvec3 corner{0.0};
    corner[i] = 1.0;
    EXPECT_LT(glm::length(planes.perspective(p.x, p.y) - corner),
              1e-13);  // window / area roundings
    EXPECT_NEAR(planes.reciprocal_w.at(p.x, p.y), p.w, 1e-14);
    EXPECT_NEAR(planes.depth.at(p.x, p.y), p.z, 1e-14);
  }
}

TEST(RasterReference, PerspectiveInterpolationRecoversAPlaneAttribute) {
  const View view = random_view(97, 60, DepthMode::standard, 3);
  const auto attribute = [](dvec3 p) { return dvec4(p, 2.0 * p.x - 3.0 * p.y + 0.5 * p.z + 1.0); };
  Varyings varyings;
  for (const dvec3& p : view.points) varyings.values.emplace_back(attribute(p));
  const Grid<dvec4> got = cpu::interpolate(view.list, varyings, Snapping::mesa);
  const Coverage coverage = cpu::edge_coverage(view.list, Snapping::mesa);
  int judged = 0;
  for (int y = 0; y < 97; ++y)
    for (int x = 0; x < 97; ++x) {
      const std::uint32_t last = coverage.last[std::size_t(y * 97 + x)];
      EXPECT_EQ(last == 0, std::isnan(got(x, y).x));
      if (last == 0) continue;
      const dvec3 seen = seen_point(view, last - 1, x, y);
      // Clip positions and values are floats: 2^-24 of 100 m, and what a tilted plane makes of it.
      const dvec3* p = &view.points[3 * (last - 1)];
      const dvec3 normal = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
      const double tilt = std::abs(glm::dot(normal, glm::normalize(seen)));
      EXPECT_LT(glm::length(got(x, y) - attribute(seen)), 100.0 * 0x1p-24 * 10.0 / (tilt * tilt));
      ++judged;
    }
  EXPECT_GT(judged, 1000);
}

TEST(RasterReference, AffineInterpolationIsAffineInTheWindow) {
  TriangleList list = empty_list(64, 64, 1);
  add_triangle(list, {-1, -1, 0.5f, 1}, {4, -4, 2, 4}, {-2, 2, 1, 2});  // covers half the window
  const Varyings varyings{{vec4(0, 0, 7, 1), vec4(64, 0, 7, 1), vec4(0, 64, 7, 1)}, false};
  const Grid<dvec4> values = cpu::interpolate(list, varyings, Snapping::mesa);
  int judged = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      if (std::isnan(values(x, y).x)) continue;
      EXPECT_LT(glm::length(values(x, y) - dvec4(x + 0.5, y + 0.5, 7, 1)), 1e-12);
      ++judged;
    }
  EXPECT_EQ(judged, 63 * 64 / 2);  // 63 + 62 + ... + 0: centres on the right edge are out
}

TEST(RasterReference, InterpolateRefusesWhatDoesNotFit) {
  View view = random_view(8, 1, DepthMode::standard, 1);
  EXPECT_THROW(cpu::interpolate(view.list, {}, Snapping::mesa), std::invalid_argument);
  Varyings varyings{std::vector<vec4>(3), true};
  view.list.samples = 4;
  EXPECT_THROW(cpu::interpolate(view.list, varyings, Snapping::mesa), std::invalid_argument);
  EXPECT_THROW(cpu::interpolate_bound(view.list, varyings, Snapping::mesa), std::invalid_argument);
}

/// An affine function set up and evaluated in float, as a device might.
float float_plane(const std::array<vec2, 3>& p, const vec3& a, vec2 at) {
  const vec2 u = p[1] - p[0], v = p[2] - p[0];
  const float scale = 1.0f / (u.x * v.y - u.y * v.x);
  const float dx = ((a.y - a.x) * v.y - (a.z - a.x) * u.y) * scale;
  const float dy = ((a.z - a.x) * u.x - (a.y - a.x) * v.x) * scale;
  const float origin = a.x - (dx * p[0].x + dy * p[0].y);
  return (origin + dx * at.x) + dy * at.y;
}

struct Deviation {
  int inside = 0;
  int outside = 0;
};

/// How often a float device lies inside the bound: with vertices snapped or not, perspective or
/// not.
Deviation deviation(const View& view, const Varyings& varyings, bool snapped, bool perspective) {
  const Grid<dvec4> exact = cpu::interpolate(view.list, varyings, Snapping::mesa);
  const Grid<double> bound = cpu::interpolate_bound(view.list, varyings, Snapping::mesa);
  const Coverage coverage = cpu::edge_coverage(view.list, Snapping::mesa);
  const int size = view.list.width;
  Deviation result;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      const std::uint32_t last = coverage.last[std::size_t(y * size + x)];
      if (last == 0) continue;
      const uvec3 t = view.list.triangles[last - 1];
      std::array<vec2, 3> p;
      vec3 a, r;
      for (int i = 0; i < 3; ++i) {
        const vec4 c = view.list.clip_positions[t[i]];
        r[i] = perspective ? 1.0f / c.w : 1.0f;
        a[i] = varyings.values[t[i]].x * r[i];
        p[std::size_t(i)] = (vec2(c.x / c.w, c.y / c.w) + 1.0f) * 0.5f * float(size);
        if (snapped)
          p[std::size_t(i)] =
              vec2(cpu::snap(c, size, size, 1, Snapping::mesa)) / 256.0f + vec2(0.5f);
      }
      const vec2 center{x + 0.5f, y + 0.5f};
      const float got = float_plane(p, a, center) / float_plane(p, r, center);
      const bool is_inside = std::abs(double(got) - exact(x, y).x) <= bound(x, y);
      (is_inside ? result.inside : result.outside) += 1;
    }
  return result;
}

// The tolerance takes devices that evaluate in float, from snapped or unsnapped vertices, and
// refuses those that forget the perspective.
TEST(RasterReference, TheInterpolationBoundSeparatesRightFromWrong) {
  for (const unsigned seed : {1u, 2u, 3u, 4u}) {
    const View view = random_view(128, 80, DepthMode::standard, seed);
    Varyings varyings;
    std::mt19937 random{seed};
    std::uniform_real_distribution<float> unit;
    for (std::size_t i = 0; i < view.points.size(); ++i)
      varyings.values.emplace_back(unit(random), 0.0f, 0.0f, 0.0f);
    const Deviation unsnapped = deviation(view, varyings, false, true);
    EXPECT_EQ(unsnapped.outside, 0);
    EXPECT_GT(unsnapped.inside, 4000);
    EXPECT_EQ(deviation(view, varyings, true, true).outside, 0);
    const Deviation wrong = deviation(view, varyings, false, false);
    EXPECT_GT(wrong.outside, 20 * wrong.inside);
  }
}

// 1.7: depth

TEST(RasterReference, ErratumDepthIsAffineInTheWindow) {
  const auto ours = [](dvec3 screen, dvec3 depth, dvec3 w) {
    const dvec2 corners[3] = {{10.0, 20.0}, {90.0, 30.0}, {40.0, 80.0}};
    std::array<vec4, 3> clip;
    dvec2 at{0.0};
    for (int i = 0; i < 3; ++i) {
      at += screen[i] * corners[i];
      clip[std::size_t(i)] = vec4(w[i] * dvec4(corners[i] / 50.0 - 1.0, depth[i], 1.0));
    }
    return cpu::triangle_planes(clip, 100, 100).depth.at(at.x, at.y);
  };
  EXPECT_TRUE(depth_is_that_of_the_true_point(ours));
  const auto notes = [](dvec3 screen, dvec3 depth, dvec3 w) {
    return glm::dot(screen, depth / w) / glm::dot(screen, 1.0 / w);
  };
  EXPECT_FALSE(depth_is_that_of_the_true_point(notes));
}

TEST(RasterReference, DepthImagesHoldTheDepthOfTheSeenPoint) {
  for (const DepthMode mode : {DepthMode::standard, DepthMode::reverse_z, DepthMode::logarithmic}) {
    const View view = random_view(96, 40, mode, 5);
    const DepthImage image = cpu::depth_test(view.list, mode, 1.0, 100.0, Snapping::mesa);
    const Grid<double> bound =
        cpu::depth_bound(view.list, image.front, mode, {1.0, 100.0}, Snapping::mesa);
    int judged = 0;
    for (int y = 0; y < 96; ++y)
      for (int x = 0; x < 96; ++x) {
        const std::uint32_t front = image.front(x, y);
        if (front == 0) {
          EXPECT_EQ(image.depth(x, y), mode == DepthMode::reverse_z ? 0.0f : 1.0f);
          EXPECT_TRUE(std::isnan(bound(x, y)));
          continue;
        }
        const double distance = -seen_point(view, front - 1, x, y).z;
        EXPECT_NEAR(image.depth(x, y), cpu::depth_value(mode, 1.0, 100.0, distance), bound(x, y));
        ++judged;
      }
    EXPECT_GT(judged, 2000);
  }
}

TEST(RasterReference, AllDepthModesSeeTheSameTriangles) {
  const auto front = [](DepthMode mode) {
    const View view = random_view(96, 40, mode, 7);
    return cpu::depth_test(view.list, mode, 1.0, 100.0, Snapping::mesa).front;
  };
  const Grid<std::uint32_t> standard = front(DepthMode::standard);
  EXPECT_EQ(front(DepthMode::reverse_z), standard);
  EXPECT_EQ(front(DepthMode::logarithmic), standard);
}

TEST(RasterReference, TheDepthBufferForgetsTheOrderOfDrawing) {
  const View view = random_view(96, 60, DepthMode::standard, 9);
  const DepthImage image =
      cpu::depth_test(view.list, DepthMode::standard, 1.0, 100.0, Snapping::mesa);
  std::vector<std::uint32_t> order(view.list.triangles.size());
  std::iota(order.begin(), order.end(), 0u);
  std::mt19937 random{1};
  std::shuffle(order.begin(), order.end(), random);
  TriangleList shuffled = view.list;
  for (std::size_t i = 0; i < order.size(); ++i)
    shuffled.triangles[i] = view.list.triangles[order[i]];
  const DepthImage other =
      cpu::depth_test(shuffled, DepthMode::standard, 1.0, 100.0, Snapping::mesa);
  EXPECT_EQ(other.depth, image.depth);
  for (std::size_t i = 0; i < image.front.size(); ++i) {
    const std::uint32_t front = other.front.values()[i];
    EXPECT_EQ(front == 0 ? 0u : order[front - 1] + 1, image.front.values()[i]);
  }
}

TEST(RasterReference, OfEqualDepthsTheFirstDrawnStays) {
  TriangleList list = empty_list(4, 4, 1);
  const vec4 a{-1, -1, 0.5f, 1}, b{3, -1, 0.5f, 1}, c{-1, 3, 0.5f, 1};
  add_triangle(list, a, b, c);
  add_triangle(list, a, b, c);
  for (const DepthMode mode : {DepthMode::standard, DepthMode::reverse_z})
    EXPECT_EQ(cpu::depth_test(list, mode, 1.0, 10.0, Snapping::mesa).front(1, 1), 1u);
}

TEST(RasterReference, DepthStepsAreThePublishedOnes) {
  const auto step = [](DepthMode mode, double z) { return cpu::depth_step(mode, 0.1, 1e5, z); };
  EXPECT_NEAR(step(DepthMode::standard, 1000.0), 0.596, 0.0005);
  EXPECT_NEAR(step(DepthMode::reverse_z, 1000.0), 7.3e-5, 0.05e-5);
  EXPECT_NEAR(step(DepthMode::reverse_z, 5e4), 0.0028, 0.00005);
  // Here one step spans 3 % of the distance, and the slope changes along it.
  EXPECT_NEAR(cpu::depth_step_measured(DepthMode::standard, 0.1, 1e5, 5e4), 1520.0, 10.0);
  EXPECT_NEAR(step(DepthMode::standard, 5e4), 1520.0, 0.03 * 1520.0);
}

TEST(RasterReference, DepthStepsAreWhatIsMeasured) {
  for (const DepthMode mode : {DepthMode::standard, DepthMode::reverse_z, DepthMode::logarithmic})
    for (const double z : {0.11, 0.7, 3.0, 42.0, 777.0, 12345.0}) {
      const double step = cpu::depth_step(mode, 0.1, 1e5, z);
      // The slope over a step changes by the share 2 step / z; doubles know the depth to 2^-53,
      // 2^-29 of the coarsest step, more of finer ones that the differences here must resolve.
      const double rounding =
          1e-15 / std::exp2(std::ilogb(cpu::depth_value(mode, 0.1, 1e5, z)) - 23);
      EXPECT_NEAR(cpu::depth_step_measured(mode, 0.1, 1e5, z) / step, 1.0,
                  2.0 * step / z + rounding)
          << int(mode) << " " << z;
    }
}

TEST(RasterReference, DepthDistanceInvertsDepthValue) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double far : {50.0, infinity})
    for (const DepthMode mode : {DepthMode::standard, DepthMode::reverse_z})
      for (const double z : {0.5, 3.0, 40.0})
        EXPECT_NEAR(cpu::depth_distance(mode, 0.5, far, cpu::depth_value(mode, 0.5, far, z)), z,
                    1e-12 * z);
  EXPECT_EQ(cpu::depth_value(DepthMode::standard, 0.5, infinity, 5.0), 0.9);
  EXPECT_EQ(cpu::depth_value(DepthMode::logarithmic, 1.0, 16.0, 4.0), 0.5);
  EXPECT_THROW(cpu::depth_value(DepthMode::logarithmic, 1.0, infinity, 4.0), std::invalid_argument);
  EXPECT_THROW(cpu::depth_value(DepthMode::standard, 0.0, 5.0, 4.0), std::invalid_argument);
  EXPECT_THROW(cpu::depth_value(DepthMode::standard, 5.0, 5.0, 4.0), std::invalid_argument);
}

TEST(RasterReference, ErratumReverseZMendsTheFarField) {
  EXPECT_TRUE(reverse_z_mends_the_far_field([](double near, double far, double z) {
    return cpu::depth_value(DepthMode::reverse_z, near, far, z);
  }));
  EXPECT_FALSE(reverse_z_mends_the_far_field([](double, double, double z) { return 1.0 / z; }));
  EXPECT_FALSE(reverse_z_mends_the_far_field([](double near, double far, double z) {
    return cpu::depth_value(DepthMode::standard, near, far, z);
  }));
  // At the near plane it is the standard buffer that is finer: its zero is there.
  EXPECT_LT(cpu::depth_step(DepthMode::standard, 0.1, 1e5, 0.1001),
            cpu::depth_step(DepthMode::reverse_z, 0.1, 1e5, 0.1001));
}

// 1.7: the painter's algorithm

TEST(RasterReference, PainterOrderIsStableFromFarToNear) {
  const std::vector<float> keys{1.0f, 3.0f, 2.0f, 3.0f, -INFINITY, 1.0f};
  EXPECT_EQ(cpu::painter_order(keys), (std::vector<std::uint32_t>{1, 3, 2, 0, 5, 4}));
  EXPECT_TRUE(cpu::painter_order({}).empty());
  EXPECT_THROW(cpu::painter_order(std::vector<float>{NAN}), std::invalid_argument);
}

TEST(RasterReference, PainterEqualsTheDepthBufferWhereTrianglesCanBeSorted) {
  TriangleList list = empty_list(80, 60, 1);
  std::mt19937 random{31};
  std::uniform_real_distribution<double> unit;
  for (int i = 0; i < 50; ++i) {
    const double depth = unit(random);
    const auto corner = [&] {
      return clip_at(list, {80.0 * unit(random), 60.0 * unit(random)}, depth);
    };
    add_triangle(list, corner(), corner(), corner());
  }
  const DepthImage painted = cpu::painter(list, Snapping::mesa);
  const DepthImage tested = cpu::depth_test(list, DepthMode::standard, 1.0, 2.0, Snapping::mesa);
  EXPECT_EQ(painted.front, tested.front);
  EXPECT_EQ(painted.depth, tested.depth);
}

//      /\        three sticks, each over the next at one end and under the one before at the other
//     /  \       .
TEST(RasterReference, PainterFailsOnACycle) {
  TriangleList list = empty_list(80, 80, 1);
  const auto point = [](double turn, double radius) {
    const double angle = 2.0 * std::numbers::pi * turn;
    return dvec2(40.0 + radius * std::cos(angle), 40.0 + radius * std::sin(angle));
  };
  for (int i = 0; i < 3; ++i) {
    const dvec2 begin = point(i / 3.0 - 0.05, 38.0), side = point(i / 3.0 + 0.05, 38.0),
                end = point((i + 1) / 3.0 + 0.05, 38.0);
    add_triangle(list, clip_at(list, begin, 0.2), clip_at(list, side, 0.2),
                 clip_at(list, end, 0.8));
  }
  const DepthImage painted = cpu::painter(list, Snapping::mesa);
  const DepthImage tested = cpu::depth_test(list, DepthMode::standard, 1.0, 2.0, Snapping::mesa);
  int different = 0;
  for (std::size_t i = 0; i < painted.front.size(); ++i)
    different += painted.front.values()[i] != tested.front.values()[i];
  EXPECT_GT(different, 10);
}

}  // namespace
}  // namespace parity
