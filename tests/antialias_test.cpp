// Antialiasing of whole pictures: how each mode comes to the mean over pixels.
#include "tools/antialias.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "geometry/jitter.h"
#include "gpu/raster/renderer.h"
#include "gpu/sampling/antialias.h"
#include "tests/gpu_context.h"
#include "tests/small_scene.h"

namespace parity {
namespace {

constexpr float refine_all = -1, refine_none = 2;
/// Stored as half, rounded to either side; shading in float.
constexpr double half_step = 0x1p-11;

/// Triangles of one colour each: opaque ones that cross each other, one of a mask, two of glass.
SmallScene flat_triangles() {
  SmallScene scene;
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(-1.1f, 1.1f), depth(-2.4f, -0.6f), shade(0, 1);
  for (int i = 0; i < 24; ++i) {
    Material material = unlit({shade(random), shade(random), shade(random), 1});
    if (i % 8 == 7) material.base_color.w = 0.4f;
    if (i == 3) material.alpha_mode = AlphaMode::mask;
    if (i == 7 || i == 15) material.alpha_mode = AlphaMode::blend;
    material.double_sided = true;
    Primitive p;
    p.material = scene.add_material(material);
    for (int k = 0; k < 3; ++k)
      p.positions.emplace_back(place(random), place(random), depth(random));
    p.normals.assign(3, vec3(0, 0, 1));
    p.indices = {0, 1, 2};
    scene.add(p);
  }
  return scene;
}

/// A square whose colour grows linearly over the screen.
SmallScene ramp() {
  SmallScene scene;
  Primitive p = quad(scene.add_material(unlit({1, 1, 1, 1})));
  p.colors = {
      {0.1f, 0.2f, 0.3f, 1}, {0.5f, 0.2f, 0.4f, 1}, {0.5f, 0.8f, 0.6f, 1}, {0.1f, 0.8f, 0.5f, 1}};
  scene.add(p);
  return scene;
}

/// The mean over the 16 places (4i + j, 4j + i), a place in each column and row of sixteenths.
Grid<dvec4> mean_of_16(const SmallScene& scene, const Frame& frame) {
  Grid<dvec4> mean(frame.options.width, frame.options.height);
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const dvec2 place = (dvec2(4 * i + j, 4 * j + i) - 7.5) / 16.0;
      const Picture picture = cpu::render(scene.scene, shifted(frame, -place)).picture;
      for (std::size_t p = 0; p < mean.size(); ++p)
        mean.values()[p] += dvec4(picture.color.values()[p]) / 16.0;
    }
  return mean;
}

void expect_colors(const Grid<vec4>& got, const Grid<dvec4>& want, double tolerance) {
  for (int y = 0; y < want.height(); ++y)
    for (int x = 0; x < want.width(); ++x) {
      SCOPED_TRACE(std::to_string(x) + ", " + std::to_string(y));
      expect_color(got(x, y), want(x, y), tolerance);
    }
}

TEST(AdaptiveAntialiasing, RefinesToTheMeanOfSixteenPlaces) {
  if (!gpu::can_render(test_context().info())) GTEST_SKIP() << "skipped: the device cannot render";
  for (const DepthMode depth : {DepthMode::reverse_z, DepthMode::standard}) {
    const SmallScene scene = flat_triangles();
    const Frame frame = scene.frame(21, 1, depth);
    gpu::Antialiaser antialiaser(test_context(), scene.scene);
    const Picture got = antialiaser.adaptive(frame, refine_all, 1);
    EXPECT_EQ(antialiaser.refined(), 1);
    expect_colors(got.color, mean_of_16(scene, frame), half_step);
  }
}

/// The places at which shades are taken have the pixel's middle as their mean.
TEST(AdaptiveAntialiasing, LeavesALinearColourAsItIs) {
  if (!gpu::can_render(test_context().info())) GTEST_SKIP() << "skipped: the device cannot render";
  const SmallScene scene = ramp();
  const Frame frame = scene.frame(16);
  gpu::Antialiaser antialiaser(test_context(), scene.scene);
  const Grid<vec4> plain = gpu::render(test_context(), scene.scene, frame).color;
  for (const float contrast : {refine_all, refine_none}) {  // both sides are stored as halves
    const Grid<vec4> got = antialiaser.adaptive(frame, contrast, 1).color;
    for (int y = 1; y < 15; ++y)
      for (int x = 1; x < 15; ++x) expect_color(got(x, y), dvec4(plain(x, y)), 2 * half_step);
  }
}

TEST(AdaptiveAntialiasing, TakesTheMeanOfSmoothPixelsFromThoseAround) {
  if (!gpu::can_render(test_context().info())) GTEST_SKIP() << "skipped: the device cannot render";
  const SmallScene scene = flat_triangles();
  const Frame frame = scene.frame(19);
  gpu::Antialiaser antialiaser(test_context(), scene.scene);
  const Grid<vec4> got = antialiaser.adaptive(frame, refine_none, 1).color;
  EXPECT_EQ(antialiaser.refined(), 0);
  const Grid<vec4> plain = gpu::render(test_context(), scene.scene, frame).color;
  const auto at = [&](int x, int y) {
    return dvec4(plain(std::clamp(x, 0, 18), std::clamp(y, 0, 18)));
  };
  Grid<dvec4> want(19, 19);
  for (int y = 0; y < 19; ++y)
    for (int x = 0; x < 19; ++x)
      want(x, y) =
          at(x, y) * (5.0 / 6) + (at(x - 1, y) + at(x + 1, y) + at(x, y - 1) + at(x, y + 1)) / 24.0;
  expect_colors(got, want, half_step);
}

TEST(AdaptiveAntialiasing, RefinesWhatDiffersOnTheScreenFromAPixelAround) {
  if (!gpu::can_render(test_context().info())) GTEST_SKIP() << "skipped: the device cannot render";
  // A square of half the picture's side in its middle: 2 pixels at either side of its edge differ.
  SmallScene scene;
  scene.add(quad(scene.add_material(unlit({0.25f, 0.25f, 0.25f, 1})), -1, 0.5f));
  Frame frame = scene.frame(16);
  frame.options.background = {0, 0, 0, 1};
  gpu::Antialiaser antialiaser(test_context(), scene.scene);
  antialiaser.adaptive(frame, 0.49f, 1);  // gamma 2 shows a quarter as a half
  EXPECT_EQ(antialiaser.refined(), (10 * 10 - 6 * 6) / 256.0);
  antialiaser.adaptive(frame, 0.51f, 1);
  EXPECT_EQ(antialiaser.refined(), 0);
  antialiaser.adaptive(frame, 0.51f, 2);  // twice as bright
  EXPECT_EQ(antialiaser.refined(), (10 * 10 - 6 * 6) / 256.0);
}

TEST(AdaptiveAntialiasing, RefinesWhatCoversNothingInPart) {
  // Black over nothing: only alpha tells the square from what will be put behind it.
  if (!gpu::can_render(test_context().info())) GTEST_SKIP() << "skipped: the device cannot render";
  SmallScene scene;
  scene.add(quad(scene.add_material(unlit({0, 0, 0, 1})), -1, 0.53f));
  Frame frame = scene.frame(16);
  frame.options.background = vec4(0);
  gpu::Antialiaser antialiaser(test_context(), scene.scene);
  const Grid<vec4> got = antialiaser.adaptive(frame, 0.04f, 1).color;
  EXPECT_EQ(antialiaser.refined(), (10 * 10 - 6 * 6) / 256.0);
  expect_colors(got, mean_of_16(scene, frame), half_step);
}

TEST(Antialiasing, ModesAreReadAndRefused) {
  using tools::parse_antialiasing;
  for (const char* text : {"none", "msaa2", "msaa8", "ssaa4", "ssaa64", "accumulate7", "adaptive",
                           "auto", "ssaa16:lanczos"})
    EXPECT_EQ(name_of(parse_antialiasing(text)), text);
  for (const char* text :
       {"", "msaa", "msaa3", "ssaa8", "ssaa", "accumulate0", "accumulate9999", "accumulate4x",
        "adaptive2", "fxaa", "ssaa16:", "ssaa16:cubic", "msaa4:tent"})
    EXPECT_THROW(parse_antialiasing(text), std::invalid_argument) << text;
}

/// A white quad without light, turned in the picture's plane, before black.
Scene turned_quad() {
  Scene scene;
  Material white;
  white.unlit = true;
  white.double_sided = true;
  scene.materials = {white};
  Primitive quad;
  for (const vec2 p : {vec2(-1.1f, -0.8f), vec2(0.9f, -1.2f), vec2(1.2f, 0.7f), vec2(-0.8f, 1.1f)})
    quad.positions.push_back(vec3(p, 0));
  quad.indices = {0, 1, 2, 0, 2, 3};
  quad.material = 0;
  scene.meshes = {{"quad", {quad}}};
  Node node;
  node.mesh = 0;
  scene.nodes.push_back(node);
  return scene;
}

double edge_error(const Picture& picture, const Grid<vec4>& truth) {
  double sum = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    sum += std::pow(double(picture.color.values()[i].x) - double(truth.values()[i].x), 2);
  return std::sqrt(sum);
}

TEST(Antialiasing, MoreSamplesComeCloserToTheMeanOfManyFrames) {
  const Scene scene = turned_quad();
  const Frame frame = make_frame(scene, {.width = 40, .height = 40, .background = {0, 0, 0, 1}});
  gpu::Context& context = test_context();
  const auto error = [&,
                      truth = tools::render_antialiased(context, scene, frame,
                                                        tools::parse_antialiasing("accumulate64"))
                                  .picture.color](const char* mode) {
    return edge_error(
        tools::render_antialiased(context, scene, frame, tools::parse_antialiasing(mode)).picture,
        truth);
  };
  const double none = error("none");
  EXPECT_GT(none, 1);  // about 80 pixels at the edges are wrong by 0.29
  EXPECT_LT(error("msaa4"), 0.6 * none);
  EXPECT_LT(error("ssaa16"), 0.35 * none);
  EXPECT_LT(error("accumulate16"), 0.35 * none);
  EXPECT_LT(error("adaptive"), 0.35 * none);
}

/// A white and a black sheet that go through each other along a slanted line.
Scene crossing_sheets() {
  Scene scene;
  for (const float side : {1.0f, -1.0f}) {
    Material material;
    material.unlit = true;
    material.double_sided = true;
    material.base_color = vec4(vec3(side > 0 ? 1.0f : 0.0f), 1);
    scene.materials.push_back(material);
    Primitive sheet;
    for (const vec2 p : {vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, 1)})
      sheet.positions.push_back(vec3(p, side * (0.4f * p.x + 0.15f * p.y)));
    sheet.indices = {0, 1, 2, 0, 2, 3};
    sheet.material = int(scene.meshes.size());
    Node node;
    node.mesh = sheet.material;
    scene.nodes.push_back(node);
    scene.meshes.push_back({"sheet", {sheet}});
  }
  return scene;
}

/// Notes 1.8, read literally: four subsamples a pixel for coverage only. Each takes the nearest at
/// the pixel's centre of the draws that cover the subsample; draw 0 is white, draw 1 is black.
Grid<vec4> with_one_depth_a_pixel(const Scene& scene, const Frame& frame) {
  const auto depths = [&](std::size_t draw, dvec2 shift) {
    Frame alone = frame;
    alone.draws = {frame.draws.at(draw)};
    return cpu::render(scene, shifted(alone, shift), {.colors = false}).picture.depth;
  };
  const Grid<float> centers[] = {depths(0, {0, 0}), depths(1, {0, 0})};
  Grid<vec4> picture(frame.options.width, frame.options.height, vec4(0));
  for (const dvec2 place : {dvec2(-2, -6), dvec2(6, -2), dvec2(-6, 2), dvec2(2, 6)}) {
    const Grid<float> there[] = {depths(0, -place / 16.0), depths(1, -place / 16.0)};
    for (std::size_t i = 0; i < picture.size(); ++i) {
      const auto covers = [&](int k) { return there[k].values()[i] > 0; };
      const auto depth = [&](int k) { return covers(k) ? centers[k].values()[i] : -1.0f; };
      const bool white = covers(0) && depth(0) > depth(1);  // reversed: larger is nearer
      const float sample = white ? 1.0f : covers(1) ? 0.0f : 0.5f;
      picture.values()[i] += vec4(sample / 4);
    }
  }
  return picture;
}

TEST(Antialiasing, MsaaTestsDepthAtEachSampleNotCoverageOnly) {
  if (!gpu::can_render(test_context().info())) GTEST_SKIP() << "skipped: the device cannot render";
  const Scene scene = crossing_sheets();
  const Frame frame =
      make_frame(scene, {.width = 32, .height = 32, .background = {0.5f, 0.5f, 0.5f, 1}});
  const auto render = [&](const char* mode) {
    return tools::render_antialiased(test_context(), scene, frame, tools::parse_antialiasing(mode))
        .picture.color;
  };
  const Grid<vec4> truth = render("accumulate64");
  // In the middle both sheets cover every sample: depth alone decides. Four samples of a straight
  // border are at most 0.25 wrong, 64 frames 0.05.
  const auto antialiases_crossings = [&](const Grid<vec4>& picture) {
    for (int y = 12; y < 20; ++y)
      for (int x = 12; x < 20; ++x)
        if (std::abs(picture(x, y).x - truth(x, y).x) > 0.3f) return false;
    return true;
  };
  EXPECT_TRUE(antialiases_crossings(render("msaa4")));
  EXPECT_TRUE(antialiases_crossings(render("msaa8")));
  const auto antialiases_outlines = [](const Grid<vec4>& picture) {
    return std::ranges::any_of(picture,
                               [](const vec4& c) { return c.x != 0 && c.x != 0.5f && c.x != 1; });
  };
  const Grid<vec4> of_the_notes = with_one_depth_a_pixel(scene, frame);
  EXPECT_TRUE(antialiases_outlines(of_the_notes));
  EXPECT_FALSE(antialiases_outlines(render("none")));
  EXPECT_FALSE(antialiases_crossings(of_the_notes));
}

TEST(Antialiasing, BothSidesAccumulateTheSamePicture) {
  const Scene scene = turned_quad();
  const Frame frame = make_frame(scene, {.width = 24, .height = 24, .background = {0, 0, 0, 1}});
  const tools::Antialiasing mode = tools::parse_antialiasing("accumulate4");
  const Picture device = tools::render_antialiased(test_context(), scene, frame, mode).picture;
  const Picture host = tools::render_antialiased(scene, frame, mode).picture;
  // White and black are exact in half precision; a quarter's weight too.
  EXPECT_EQ(device.color, host.color);
}

TEST(Antialiasing, BothSidesMakeLargerPicturesSmallByTheSameFilter) {
  const Scene scene = turned_quad();
  const Frame frame = make_frame(scene, {.width = 24, .height = 24, .background = vec4(0)});
  for (const char* text :
       {"ssaa16", "ssaa16:tent", "ssaa16:gaussian", "ssaa16:mitchell", "ssaa4:lanczos"}) {
    const tools::Antialiasing mode = tools::parse_antialiasing(text);
    const Picture device = tools::render_antialiased(test_context(), scene, frame, mode).picture;
    const Picture host = tools::render_antialiased(scene, frame, mode).picture;
    double apart = 0;
    for (std::size_t i = 0; i < host.color.size(); ++i) {
      const vec4 &a = device.color.values()[i], &b = host.color.values()[i];
      apart = std::max(apart, double(glm::length(a - b)));
      EXPECT_TRUE(a.x >= 0 && a.w >= 0 && a.w <= 1) << text;
    }
    // Two sums of at most 49 products of numbers up to 1, float: 2 49 u each, in four channels.
    EXPECT_LT(apart, 4 * 98 * 0x1p-24) << text;
  }
}

/// As it is over a background: where there is nothing, that is seen.
Grid<vec4> over_grey(const Picture& picture, float grey) {
  Grid<vec4> color = picture.color;
  for (vec4& c : color) c = vec4(vec3(c) + grey * (1 - c.w), 1);
  return color;
}

TEST(Antialiasing, AutoMeetsTheErrorOnWhatIsShown) {
  // A black quad over nothing, shown over white: the colours alone are black throughout.
  Scene scene = turned_quad();
  scene.materials[0].base_color = {0, 0, 0, 1};
  const Frame frame = make_frame(scene, {.width = 24, .height = 24, .background = vec4(0)});
  const auto choose = [&](double max_error, float grey) {
    return tools::render_antialiased(
        test_context(), scene, frame,
        {.kind = tools::Antialiasing::Kind::automatic, .max_error = max_error},
        {.shown = [=](const Picture& picture) { return over_grey(picture, grey); }});
  };
  const auto error_of = [](const tools::Antialiased& result, const std::string& mode) {
    return std::ranges::find(result.trials, mode, &tools::AntialiasingTrial::mode)->error;
  };
  const tools::Antialiased all = choose(1, 1);
  const double least = error_of(all, "accumulate16"), most = error_of(all, "none");
  ASSERT_LT(least, 0.5 * most);
  EXPECT_EQ(error_of(choose(1, 0), "none"), 0);
  const double bound = 0.5 * (least + most);
  const tools::Antialiased result = choose(bound, 1);
  ASSERT_TRUE(result.meets);
  EXPECT_LE(error_of(result, result.mode), bound);
  const auto chosen =
      std::ranges::find(result.trials, result.mode, &tools::AntialiasingTrial::mode);
  for (const tools::AntialiasingTrial& other : result.trials)
    EXPECT_TRUE(other.error > bound || other.seconds >= chosen->seconds) << other.mode;
}

TEST(Antialiasing, AutoTakesTheFastestThatMeetsTheError) {
  const Scene scene = turned_quad();
  const Frame frame = make_frame(scene, {.width = 24, .height = 24, .background = {0, 0, 0, 1}});
  const auto choose = [&](double max_error) {
    return tools::render_antialiased(
        test_context(), scene, frame,
        {.kind = tools::Antialiasing::Kind::automatic, .max_error = max_error});
  };
  const tools::Antialiased loose = choose(1);
  ASSERT_TRUE(loose.meets);
  const auto chosen = std::ranges::find(loose.trials, loose.mode, &tools::AntialiasingTrial::mode);
  ASSERT_NE(chosen, loose.trials.end());
  for (const tools::AntialiasingTrial& other : loose.trials)
    EXPECT_LE(chosen->seconds, other.seconds);
  EXPECT_FALSE(choose(0).meets);
}

}  // namespace
}  // namespace parity
