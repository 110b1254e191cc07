// Blending and sRGB in the reference.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include "cpu_reference/raster/blend.h"
#include "cpu_reference/raster/srgb.h"

namespace parity {
namespace {

Grid<vec4> one_pixel(vec4 color) { return Grid<vec4>{1, 1, color}; }

TEST(RasterReference, BlendsByTheClosedForms) {
  const std::vector<Grid<vec4>> layers{one_pixel({1.0f, 0.5f, 0.0f, 1.0f}),
                                       one_pixel({0.0f, 1.0f, 0.5f, 0.25f})};
  EXPECT_EQ(cpu::blend(layers, BlendMode::over)(0, 0), dvec4(0.75, 0.625, 0.125, 1.0));
  EXPECT_EQ(cpu::blend(layers, BlendMode::over_premultiplied)(0, 0), dvec4(0.75, 1.375, 0.5, 1.0));
  EXPECT_EQ(cpu::blend(layers, BlendMode::add)(0, 0), dvec4(1.0, 1.5, 0.5, 1.25));
  // The first layer goes on nothing.
  EXPECT_EQ(cpu::blend({layers[1]}, BlendMode::over)(0, 0), dvec4(0.0, 0.25, 0.125, 0.25));
}

TEST(RasterReference, OverOfMultipliedColoursEqualsPremultipliedOver) {
  std::mt19937 random{37};
  std::uniform_real_distribution<float> unit;
  std::vector<Grid<vec4>> straight, multiplied;
  for (int i = 0; i < 5; ++i) {
    const vec4 c =
        glm::round(vec4(unit(random), unit(random), unit(random), unit(random)) * 64.0f) /
        64.0f;  // products are exact
    straight.push_back(one_pixel(c));
    multiplied.push_back(one_pixel({c.x * c.w, c.y * c.w, c.z * c.w, c.w}));
  }
  const dvec4 a = cpu::blend(straight, BlendMode::over)(0, 0);
  const dvec4 b = cpu::blend(multiplied, BlendMode::over_premultiplied)(0, 0);
  EXPECT_LT(glm::length(a - b), 20.0 * 0x1p-53);
  std::swap(straight[1], straight[3]);
  EXPECT_GT(glm::length(cpu::blend(straight, BlendMode::over)(0, 0) - a), 0.01);  // order matters
}

TEST(RasterReference, BlendingInBytesStaysWithinHalfALevelAPass) {
  std::mt19937 random{41};
  std::uniform_real_distribution<float> unit;
  std::vector<Grid<vec4>> layers;
  for (int i = 0; i < 4; ++i) {
    layers.emplace_back(31, 17);
    for (vec4& c : layers.back()) c = vec4(unit(random), unit(random), unit(random), unit(random));
  }
  const Grid<dvec4> exact = cpu::blend(layers, BlendMode::over);
  const Grid<dvec4> bytes = cpu::blend_unorm8(layers, BlendMode::over);
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const dvec4 levels = bytes.values()[i] * 255.0;
    EXPECT_LT(glm::length(levels - glm::round(levels)), 1e-12);
    const dvec4 off = glm::abs(levels - exact.values()[i] * 255.0);
    EXPECT_LE(std::max({off.x, off.y, off.z, off.w}), 4 * 0.5 + 1e-12);
  }
}

TEST(RasterReference, BlendRefusesWhatDoesNotFit) {
  EXPECT_THROW(cpu::blend({}, BlendMode::over), std::invalid_argument);
  EXPECT_THROW(cpu::blend({one_pixel(vec4(0)), Grid<vec4>{2, 1}}, BlendMode::add),
               std::invalid_argument);
}

TEST(RasterReference, SrgbGivesBackEveryCode) {
  Grid<vec4> linear{256, 1};
  for (int code = 0; code < 256; ++code) {
    const double c = code / 255.0;
    const double decoded = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
    linear(code, 0) = vec4(vec3(float(decoded)), float(c));
  }
  const Grid<u8vec4> encoded = cpu::encode_srgb(linear, 0.0f);
  for (int code = 0; code < 256; ++code)
    EXPECT_EQ(encoded(code, 0), u8vec4(std::uint8_t(code))) << code;
}

TEST(RasterReference, SrgbClampsExposesAndSurvivesEveryNumber) {
  const Grid<vec4> linear{1, 1, vec4(0.25f, -1.0f, INFINITY, NAN)};
  EXPECT_EQ(cpu::encode_srgb(linear, 2.0f)(0, 0), u8vec4(255, 0, 255, 0));
  // 0.0625 encodes to 0.2773 * 255 = 70.7
  EXPECT_EQ(cpu::encode_srgb(linear, -2.0f)(0, 0).x, 71);
  EXPECT_NEAR(cpu::srgb_from_linear(0.0031308), cpu::srgb_from_linear(0.0031309), 2e-6);
  EXPECT_NEAR(cpu::srgb_from_linear(1.0), 1.0, 0x1p-52);
  EXPECT_TRUE(cpu::encode_srgb({}, 0.0f).empty());
}

}  // namespace
}  // namespace parity
