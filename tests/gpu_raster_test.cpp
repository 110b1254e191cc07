// What the device's rasterisers owe each other and to mathematics; no reference on the CPU.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "gpu/raster/blend.h"
#include "gpu/raster/clip.h"
#include "gpu/raster/depth.h"
#include "gpu/raster/edge_coverage.h"
#include "gpu/raster/encode_srgb.h"
#include "gpu/raster/interpolate.h"
#include "gpu/raster/polygon_fill.h"
#include "gpu/raster/scanline_fill.h"
#include "gpu/raster/viewport.h"
#include "tests/gpu_context.h"

namespace parity {
namespace {

Snapping device_snapping(const gpu::Context& context) {
  return context.info().is_swiftshader ? Snapping::swiftshader : Snapping::mesa;
}

/// A clip position that lands on (x, y) of the window.
vec4 at_window(const TriangleList& list, float x, float y, float depth, float w) {
  return vec4(2 * x / float(list.width) - 1, 2 * y / float(list.height) - 1, depth, 1) * w;
}

/// Triangles inside the window: any, slivers, and with corners on pixel centres and edges.
TriangleList random_triangles(int width, int height, int samples, int count, std::uint32_t seed) {
  TriangleList list{.width = width, .height = height, .samples = samples};
  std::mt19937 random(seed);
  const auto uniform = [&](float low, float high) {
    return low + (high - low) * float(random() >> 8) / float(1 << 24);
  };
  for (int t = 0; t < count; ++t) {
    const float reach = t % 3 == 0 ? 200.0f : (t % 3 == 1 ? 20.0f : 3.0f);
    const float step = t % 4 == 0 ? 2.0f : 0.0f;  // corners on halves of pixels
    const float x = uniform(0, float(width)), y = uniform(0, float(height));
    for (int corner = 0; corner < 3; ++corner) {
      float px = std::clamp(x + uniform(-reach, reach), 0.0f, float(width));
      float py =
          std::clamp(y + (t % 5 == 0 ? 0.05f : 1.0f) * uniform(-reach, reach), 0.0f, float(height));
      if (step > 0) px = std::round(px * step) / step, py = std::round(py * step) / step;
      list.clip_positions.push_back(at_window(list, px, py, uniform(0, 1), uniform(0.5f, 4)));
    }
    const auto first = std::uint32_t(3 * t);
    list.triangles.push_back({first, first + 1, first + 2});
  }
  return list;
}

std::size_t differences(const Coverage& a, const Coverage& b) {
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < a.count.size(); ++i)
    wrong += a.count[i] != b.count[i] || a.last[i] != b.last[i];
  return wrong;
}

TEST(GpuCoverage, OfComputeIsThatOfTheFixedFunctionBitForBit) {
  gpu::Context& context = test_context();
  if (!context.info().is_mesa_software && !context.info().is_swiftshader)
    GTEST_SKIP() << "skipped: the snapping of this device is not known";
  for (const int samples : {1, 4})
    for (const auto& [width, height] : {std::pair{512, 512}, {131, 77}}) {
      const TriangleList list = random_triangles(width, height, samples, 1500, 7);
      const Coverage hardware = gpu::hardware_coverage(context, list);
      const Coverage compute = gpu::edge_coverage(context, list, device_snapping(context));
      EXPECT_EQ(differences(hardware, compute), 0u) << width << " at " << samples;
    }
}

TEST(GpuCoverage, OfSpansIsThatOfEdgeFunctions) {
  for (const int samples : {1, 2, 4, 8}) {
    const TriangleList list = random_triangles(131, 77, samples, 500, 11);
    const Coverage edges = gpu::edge_coverage(test_context(), list, Snapping::mesa);
    EXPECT_EQ(differences(edges, gpu::scanline_fill(test_context(), list, Snapping::mesa)), 0u);
    EXPECT_GT(std::accumulate(edges.count.begin(), edges.count.end(), 0u), 1000u);
  }
}

/// A grid of n x n quads with shaken corners that covers more than the view, tilted so that part of
/// it lies behind the eye if `tilt` is over 1.
TriangleList shaken_grid(int side, int samples, int n, float tilt) {
  TriangleList list{.width = side, .height = side, .samples = samples};
  std::mt19937 random(5);
  const auto shake = [&] { return 0.4f * (float(random() >> 8) / float(1 << 23) - 1); };
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const float x = 2.4f * (float(i) + shake()) / float(n) - 1.2f;
      const float y = 2.4f * (float(j) + shake()) / float(n) - 1.2f;
      const float w = 1 + tilt * y;
      list.clip_positions.emplace_back(4 * x, y * (1 + tilt), 0.5f * w, w);
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const auto a = std::uint32_t(j * (n + 1) + i), b = a + 1, c = a + std::uint32_t(n) + 1;
      list.triangles.emplace_back(a, b, c + 1);
      list.triangles.emplace_back(c + 1, c, a);
    }
  return list;
}

// The plane w = 1 + tilt y, seen whole where w > 0: y / w (1 + tilt) reaches -1 and 1 within the
// grid for all three tilts, so every sample of the upper half is covered, exactly once.
TEST(GpuCoverage, OfAWatertightMeshIsOnceEverywhere) {
  for (const int samples : {1, 2, 4, 8})
    for (const float tilt : {0.0f, 0.5f, 3.0f}) {
      const TriangleList list = shaken_grid(64, samples, 24, tilt);
      const Coverage coverage = gpu::edge_coverage(test_context(), list, Snapping::mesa);
      const std::size_t half = coverage.count.size() / 2;
      std::size_t wrong = 0;
      for (std::size_t i = 0; i < coverage.count.size(); ++i)
        wrong += coverage.count[i] > 1 || (i >= half && coverage.count[i] != 1);
      EXPECT_EQ(wrong, 0u) << samples << " samples, tilt " << tilt;
    }
}

// Cut by the guard band, the near and the far plane, a triangle leaves up to seven pieces;
// somewhere among them is the view.
TEST(GpuCoverage, OfATriangleAroundTheViewIsOnceHoweverItIsCut) {
  TriangleList list{.width = 16, .height = 16, .samples = 1};
  std::mt19937 random(13);
  const auto any = [&] { return 2 * double(random() >> 8) / double(1 << 24) - 1; };
  constexpr std::uint32_t count = 500;
  for (std::uint32_t t = 0; t < count; ++t) {
    // The inner circle of the triangle, 15000 px wide, holds the view; depth is 0.5 there or near
    // it.
    const dvec2 middle{10000 * any(), 10000 * any()};
    const double turn = 3.2 * any(), tilt = 1 / 20000.0;
    const dvec2 slope = tilt * glm::normalize(dvec2(any(), any()));
    for (int corner = 0; corner < 3; ++corner) {
      const double angle = turn + corner * 2.0943951;
      const dvec2 p = middle + 30000.0 * dvec2(std::cos(angle), std::sin(angle));
      list.clip_positions.push_back(vec4(dvec4(p / 8.0, 0.5 + glm::dot(slope, p), 1)));
    }
    list.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  const Coverage coverage = gpu::edge_coverage(test_context(), list, Snapping::mesa);
  for (const std::uint32_t covered : coverage.count) ASSERT_EQ(covered, count);
}

TEST(GpuCoverage, RefusesWhatItCannotDraw) {
  TriangleList list = random_triangles(16, 16, 1, 1, 1);
  list.triangles[0].z = 99;
  EXPECT_THROW(gpu::edge_coverage(test_context(), list, Snapping::mesa), std::invalid_argument);
  list.triangles.clear();
  const Coverage none = gpu::edge_coverage(test_context(), list, Snapping::mesa);
  EXPECT_EQ(std::accumulate(none.count.begin(), none.count.end(), 0u), 0u);
  list.samples = 3;
  EXPECT_THROW(gpu::edge_coverage(test_context(), list, Snapping::mesa), std::invalid_argument);
}

TEST(GpuCoverage, SurvivesNumbersThatAreNone) {
  TriangleList list = random_triangles(40, 40, 4, 30, 2);
  const float infinity = std::numeric_limits<float>::infinity();
  list.clip_positions[0].x = std::nanf("");
  list.clip_positions[4].w = 0;
  list.clip_positions[8].y = infinity;
  list.clip_positions[12] = vec4(3e38f, -3e38f, 0, 3e38f);
  list.clip_positions[15].w = -1;
  list.clip_positions[18] = vec4(1e9f, 5, 0.5f, 1);
  const Coverage coverage = gpu::edge_coverage(test_context(), list, Snapping::mesa);
  EXPECT_LE(*std::max_element(coverage.count.begin(), coverage.count.end()), 30u);
}

TEST(GpuInterpolate, AgreesWithTheFixedFunction) {
  TriangleList list = random_triangles(200, 100, 1, 60, 3);
  Varyings varyings;
  for (std::size_t i = 0; i < list.clip_positions.size(); ++i)
    varyings.values.emplace_back(float(i % 3 == 0), float(i % 3 == 1), float(i % 3 == 2), 1);
  for (const bool perspective : {true, false}) {
    varyings.perspective = perspective;
    const Snapping snapping = device_snapping(test_context());
    const Grid<vec4> compute = gpu::interpolate(test_context(), list, varyings, snapping);
    const Grid<vec4> hardware = gpu::hardware_interpolate(test_context(), list, varyings);
    std::vector<float> errors;
    for (std::size_t i = 0; i < compute.size(); ++i) {
      const vec4 d = glm::abs(compute.values()[i] - hardware.values()[i]);
      errors.push_back(std::max({d.x, d.y, d.z}));
    }
    // Snapping moves corners by 2^-9 pixel: slivers a few units wide have no bound, most have.
    std::sort(errors.begin(), errors.end());
    EXPECT_LT(errors[errors.size() * 9 / 10], 1e-3f);
  }
}

TEST(GpuDepth, OfComputeAgreesWithTheFixedFunction) {
  TriangleList list = random_triangles(200, 100, 1, 200, 4);
  for (std::size_t i = 0; i < list.clip_positions.size(); ++i) {
    vec4& p = list.clip_positions[i];
    p.z = (0.2f + 0.003f * float(i / 3)) * p.w;  // parallel to the window, 0.003 apart
  }
  for (const DepthMode mode : {DepthMode::standard, DepthMode::reverse_z}) {
    const Snapping snapping = device_snapping(test_context());
    const DepthImage compute = gpu::depth_test(test_context(), list, mode, 0, 0, snapping);
    const DepthImage hardware = gpu::hardware_depth_test(test_context(), list, mode, 0, 0);
    EXPECT_EQ(compute.front, hardware.front);
    for (std::size_t i = 0; i < compute.depth.size(); ++i)
      ASSERT_NEAR(compute.depth.values()[i], hardware.depth.values()[i], 4e-7f);
  }
}

TEST(GpuDepth, OfEqualDepthsTheFirstDrawnStays) {
  TriangleList list = random_triangles(40, 40, 1, 20, 12);
  const auto single = std::uint32_t(list.triangles.size());
  for (std::uint32_t t = 0; t < single; ++t) list.triangles.push_back(list.triangles[t]);
  for (const DepthMode mode : {DepthMode::standard, DepthMode::reverse_z}) {
    const DepthImage compute =
        gpu::depth_test(test_context(), list, mode, 0, 0, device_snapping(test_context()));
    const DepthImage hardware = gpu::hardware_depth_test(test_context(), list, mode, 0, 0);
    for (const DepthImage* image : {&compute, &hardware})
      EXPECT_LE(*std::max_element(image->front.begin(), image->front.end()), single);
  }
}

// Depth is affine in the window whatever the perspective (erratum of notes 1.3). Corners on pixel
// corners: nothing is lost by snapping.
TEST(GpuDepth, IsAffineInTheWindow) {
  TriangleList list{.width = 64, .height = 64, .samples = 1};
  const auto depth_at = [](double x, double y) { return 0.1 + 0.004 * x + 0.002 * y; };
  float w = 1;
  for (const vec2 corner : {vec2(-16, 64), vec2(128, -32), vec2(0, -32)}) {
    list.clip_positions.push_back(
        at_window(list, corner.x, corner.y, float(depth_at(corner.x, corner.y)), w));
    w *= 8;
  }
  list.triangles = {{0, 1, 2}};
  const DepthImage compute = gpu::depth_test(test_context(), list, DepthMode::standard, 0, 0,
                                             device_snapping(test_context()));
  const DepthImage hardware =
      gpu::hardware_depth_test(test_context(), list, DepthMode::standard, 0, 0);
  int seen = 0;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      if (compute.front(x, y) == 0) continue;
      ++seen;
      // Clip positions, window positions and the plane round a dozen times, values below 1.
      EXPECT_NEAR(compute.depth(x, y), depth_at(x + 0.5, y + 0.5), 12 * 1.2e-7);
      EXPECT_NEAR(hardware.depth(x, y), depth_at(x + 0.5, y + 0.5), 24 * 1.2e-7);
    }
  EXPECT_GT(seen, 500);
}

TEST(GpuDepth, IsLogarithmicInW) {
  const float near = 0.5f, far = 4;
  TriangleList list = random_triangles(64, 64, 1, 20, 4);
  for (std::size_t i = 0; i < list.clip_positions.size(); ++i) {
    vec4& p = list.clip_positions[i];
    p = p * ((0.6f + 0.15f * float(i / 3)) / p.w);
  }
  const DepthImage compute = gpu::depth_test(test_context(), list, DepthMode::logarithmic, near,
                                             far, device_snapping(test_context()));
  const DepthImage hardware =
      gpu::hardware_depth_test(test_context(), list, DepthMode::logarithmic, near, far);
  EXPECT_EQ(compute.front, hardware.front);
  for (std::size_t i = 0; i < compute.depth.size(); ++i) {
    const std::uint32_t front = compute.front.values()[i];
    const float w = 0.6f + 0.15f * float(front - 1);
    const double want =
        front == 0 ? 1 : std::log2(double(w) / near) / std::log2(double(far) / near);
    // log2 may be off by 2^-21 near 1; interpolation of 1/w by 4 roundings.
    ASSERT_NEAR(compute.depth.values()[i], want, 1e-6);
    ASSERT_NEAR(hardware.depth.values()[i], want, 1e-6);
  }
}

TEST(GpuClip, LeavesWhatIsInsideAndCutsTheRest) {
  TriangleList list{.width = 8, .height = 8, .samples = 1};
  list.clip_positions = {
      {0, 0, 0.5f, 1}, {1, 0, 0.5f, 1}, {0, 1, 0.5f, 1}, {0, 0, -0.5f, 1}, {8, 0, 0.5f, 1}};
  list.triangles = {{0, 1, 2}, {3, 1, 2}, {0, 4, 2}};
  const std::vector<ClippedPolygon> polygons = gpu::clip(test_context(), list, 2);
  EXPECT_EQ(polygons[0].count, 3u);
  ASSERT_EQ(polygons[1].count, 4u);  // the near plane cuts a corner off, half way
  for (std::uint32_t i = 0; i < 4; ++i) EXPECT_GE(polygons[1].position[i].z, 0);
  EXPECT_EQ(polygons[2].count, 4u);  // so does x = 2 w
  for (std::uint32_t i = 0; i < 4; ++i) {
    const dvec3 b = polygons[2].barycentric[i];
    EXPECT_NEAR(b.x + b.y + b.z, 1, 1e-6);
    EXPECT_NEAR(polygons[2].position[i].x, 8 * b.y, 1e-6);
  }
}

TEST(GpuViewport, TakesCornersOfTheViewToThoseOfTheWindow) {
  const std::vector<vec4> clip{{-2, -2, 0, 2}, {1, 1, 1, 1}, {0, 0, 2, 4}};
  const std::vector<vec4> window = gpu::to_window(test_context(), clip, 131, 77);
  EXPECT_EQ(window[0], vec4(0, 0, 0, 0.5f));
  EXPECT_EQ(window[1], vec4(131, 77, 1, 1));
  EXPECT_EQ(window[2], vec4(65.5f, 38.5f, 0.5f, 0.25f));
}

// What snapping decides by: one rounding more or less moves one corner in a thousand.
TEST(GpuViewport, RoundsTheProductAndTheSumOnce) {
  std::mt19937 random(8);
  std::vector<vec4> clip;
  for (int i = 0; i < 20000; ++i) {
    const auto any = [&] { return float(random() >> 8) / float(1 << 23) - 1; };
    clip.emplace_back(any(), any(), 0.5f, 0.5f + std::abs(any()));
  }
  const std::vector<vec4> window = gpu::to_window(test_context(), clip, 1449, 877);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < clip.size(); ++i) {
    const float r = 1 / clip[i].w;
    wrong += window[i].x != std::fma(clip[i].x * r, 724.5f, 724.5f) ||
             window[i].y != std::fma(clip[i].y * r, 438.5f, 438.5f);
  }
  EXPECT_EQ(wrong, 0u);
}

TEST(GpuPolygon, FillsByEitherRule) {
  const Polygon square{{{{2, 3}, {7, 3}, {7, 9}, {2, 9}}}};
  const Grid<std::uint8_t> filled =
      gpu::polygon_fill(test_context(), square, FillRule::even_odd, 12, 12);
  EXPECT_EQ(std::accumulate(filled.begin(), filled.end(), 0), 30);
  Polygon star{{{}}};
  for (int i = 0; i < 5; ++i) {
    const double angle = 2 * i * 4 * std::acos(0.0) / 5;
    star.rings[0].emplace_back(20 + 18 * std::sin(angle), 20 - 18 * std::cos(angle));
  }
  const auto inside = [&](FillRule rule, int x, int y) {
    return int(gpu::polygon_fill(test_context(), star, rule, 40, 40)(x, y));
  };
  EXPECT_EQ(inside(FillRule::even_odd, 20, 20), 0);
  EXPECT_EQ(inside(FillRule::non_zero, 20, 20), 1);
  EXPECT_EQ(inside(FillRule::even_odd, 20, 6), 1);
  EXPECT_EQ(inside(FillRule::non_zero, 1, 1), 0);
}

TEST(GpuBlend, OfComputeIsThatOfTheBlender) {
  std::vector<Grid<vec4>> layers(3, Grid<vec4>{5, 3});
  std::mt19937 random(1);
  for (Grid<vec4>& layer : layers)
    for (vec4& texel : layer)
      for (int c = 0; c < 4; ++c) texel[c] = float(random() >> 8) / float(1 << 24);
  for (const BlendMode mode : {BlendMode::over, BlendMode::over_premultiplied, BlendMode::add}) {
    const Grid<vec4> compute = gpu::blend(test_context(), layers, mode);
    const Grid<vec4> hardware =
        gpu::hardware_blend(test_context(), layers, mode, gpu::Format::rgba32_float);
    for (std::size_t i = 0; i < compute.size(); ++i)
      for (int c = 0; c < 4; ++c)  // three layers, three roundings each of values up to 4
        EXPECT_NEAR(compute.values()[i][c], hardware.values()[i][c], 9 * 4.8e-7f);
  }
  EXPECT_THROW(gpu::blend(test_context(), {}, BlendMode::add), std::invalid_argument);
}

TEST(GpuSrgb, FindsEachCodeFromBothOfItsBorders) {
  Grid<vec4> colors{256, 2};
  const auto decoded = [](double v) {
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  };
  for (int code = 0; code < 256; ++code) {
    // The first float of the code and the last.
    const double low = decoded(std::max(0.0, (code - 0.5) / 255));
    const double high = decoded(std::min(1.0, (code + 0.5) / 255));
    float first = float(low), last = float(high);
    if (first < low) first = std::nextafter(first, 2.0f);
    if (last >= high && code < 255) last = std::nextafter(last, 0.0f);
    colors(code, 0) = vec4(first, float(decoded(code / 255.0)), last, code / 255.0f);
    colors(code, 1) = colors(code, 0) * vec4(0.25f, 0.25f, 0.25f, 1);
  }
  const Grid<u8vec4> plain = gpu::encode_srgb(test_context(), colors, 0);
  const Grid<u8vec4> exposed = gpu::encode_srgb(test_context(), colors, 2);
  for (int code = 0; code < 256; ++code) {
    EXPECT_EQ(plain(code, 0), u8vec4(code)) << code;
    EXPECT_EQ(exposed(code, 1), u8vec4(code)) << code;
  }
  const Grid<vec4> odd{1, 1, vec4(std::nanf(""), -1, 1e30f, 2)};
  EXPECT_EQ(gpu::encode_srgb(test_context(), odd, 0)(0, 0), u8vec4(0, 0, 255, 255));
}

}  // namespace
}  // namespace parity
