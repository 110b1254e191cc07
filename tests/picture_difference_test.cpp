#include "geometry/picture_difference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "geometry/flip.h"

namespace parity {
namespace {

/// Stripes and a ramp, moved to the left by `shift` pixels. All values are exact.
Grid<vec4> pattern(int shift, float scale) {
  Grid<vec4> image{96, 64};
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 96; ++x) {
      const int u = x + shift;
      const float stripe = (u / 8 + y / 8) % 2 ? 0.75f : 0.125f;
      const float ramp = float((u * 5 + y * 3) % 64) / 64.0f;
      image(x, y) = scale * vec4(stripe, ramp, 0.5f * stripe + 0.25f * ramp, 1.0f);
    }
  return image;
}

Grid<vec4> constant(vec3 color) { return Grid<vec4>{7, 5, vec4(color, 1.0f)}; }

TEST(PictureDifference, FollowsItsDefinitions) {
  Grid<vec4> a{4, 2}, b{4, 2};
  b(3, 1).y = -0.5f;
  b(1, 0).z = 0.25f;
  b(2, 1).x = 0.5f;
  b(0, 0).w = 9.0f;  // alpha does not count
  const PictureDifference d = difference(a, b);
  EXPECT_EQ(d.mse, (0.25 + 0.25 + 0.0625) / 24.0);
  EXPECT_DOUBLE_EQ(d.psnr, 10.0 * std::log10(24.0 / 0.5625));
  EXPECT_EQ(d.maximum, 0.5);
  EXPECT_EQ(d.maximum_x, 2);
  EXPECT_EQ(d.maximum_y, 1);
}

TEST(PictureDifference, EqualPicturesDifferByNothingWhateverTheyHold) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  const Grid<vec4> odd{2, 2, vec4(nan, infinity, -infinity, 0.0f)};
  EXPECT_EQ(difference(odd, odd).maximum, 0.0);
  EXPECT_EQ(difference(odd, odd).psnr, std::numeric_limits<double>::infinity());
  EXPECT_EQ(difference(odd, Grid<vec4>{2, 2}).maximum, std::numeric_limits<double>::infinity());
}

TEST(PictureDifference, RefusesSizesThatDiffer) {
  EXPECT_THROW(difference(Grid<vec4>{2, 3}, Grid<vec4>{3, 2}), std::invalid_argument);
  EXPECT_THROW(difference(Grid<vec4>{}, Grid<vec4>{}), std::invalid_argument);
  EXPECT_THROW(flip(Grid<vec4>{2, 3}, Grid<vec4>{3, 2}, 67.0), std::invalid_argument);
  EXPECT_THROW(flip(Grid<vec4>{2, 3}, Grid<vec4>{2, 3}, 0.0), std::invalid_argument);
}

TEST(Flip, EqualPicturesDifferByNothing) {
  const Grid<float> errors = flip(pattern(0, 1), pattern(0, 1), usual_pixels_per_degree);
  EXPECT_EQ(errors, Grid<float>(96, 64, 0.0f));
  EXPECT_EQ(mean(hdr_flip(pattern(0, 9), pattern(0, 9), usual_pixels_per_degree)), 0.0);
}

// Filters leave a constant as it is and see no features in it, so FLIP is the colour error alone.
// With the L*a*b* of green (87.7347, -86.1827, 83.1793) and of blue (32.2970, 79.1875, -107.8602):
//   c_max = (55.4377 + |(-75.6121 - 25.5752, 72.9772 + 34.8356)|)^0.7 = 203.299^0.7 = 41.281
// and black against white is 100^0.7 = 25.119, beyond the knee of 0.4 c_max.
TEST(Flip, OfConstantsIsTheColourErrorOfThePaper) {
  const double largest = std::pow(55.4377 + std::hypot(101.1873, 107.8128), 0.7);
  const double black_white = 0.95 + 0.05 * (std::pow(100.0, 0.7) - 0.4 * largest) / (0.6 * largest);
  // The published colours have six digits and a white point of five.
  constexpr double tolerance = 1e-5;
  EXPECT_NEAR(mean(flip(constant(vec3(0)), constant(vec3(1)), 67.0)), black_white, tolerance);
  EXPECT_NEAR(mean(flip(constant({0, 1, 0}), constant({0, 0, 1}), 67.0)), 1.0, tolerance);
  // L* of Y = 0.01 is 8.99144 (CIE); below the knee.
  EXPECT_NEAR(mean(flip(constant(vec3(0)), constant(vec3(0.01f)), 67.0)),
              0.95 / (0.4 * largest) * std::pow(8.99144, 0.7), tolerance);
}

TEST(Flip, DoesNotCareWhichPictureIsWhich) {
  EXPECT_EQ(flip(pattern(0, 1), pattern(3, 1), 67.0), flip(pattern(3, 1), pattern(0, 1), 67.0));
}

TEST(Flip, ClampsWhatAScreenCannotShow) {
  Grid<vec4> wild = pattern(0, 1), tame = wild;
  wild(5, 5) = vec4(std::numeric_limits<float>::quiet_NaN(), -3.0f,
                    std::numeric_limits<float>::infinity(), 0.0f);
  tame(5, 5) = vec4(0.0f, 0.0f, 1.0f, 0.0f);
  EXPECT_EQ(mean(flip(wild, tame, 67.0)), 0.0);
}

// The authors' own program (version 1.7, single precision) gives these for the same pictures.
TEST(Flip, AgreesWithItsAuthorsProgram) {
  const Grid<float> errors = flip(pattern(0, 1), pattern(1, 1), usual_pixels_per_degree);
  EXPECT_NEAR(mean(errors), 0.4179579, 1e-5);
  EXPECT_NEAR(errors(40, 30), 0.491168, 1e-5);
  EXPECT_NEAR(errors(0, 0), 0.476313, 1e-5);
  const Grid<float> hdr = hdr_flip(pattern(0, 20), pattern(1, 20), usual_pixels_per_degree);
  EXPECT_NEAR(mean(hdr), 0.3571362, 1e-5);
  EXPECT_NEAR(hdr(40, 30), 0.337028, 1e-5);
  EXPECT_NEAR(hdr(0, 0), 0.782402, 1e-5);
  const ExposureRange range = exposure_range(pattern(0, 20));
  EXPECT_NEAR(range.start, -3.099900, 1e-5);
  EXPECT_NEAR(range.stop, -2.138440, 1e-5);
  EXPECT_EQ(range.count, 2);
}

TEST(HdrFlip, LooksOnceAtABlackReferenceAndNotForEverAtAWideOne) {
  EXPECT_EQ(exposure_range(Grid<vec4>{3, 3}).count, 1);
  Grid<vec4> wide{3, 1, vec4(1e-38f)};
  wide(0, 0) = vec4(1e38f);
  EXPECT_EQ(exposure_range(wide).count, 32);
  EXPECT_TRUE(std::isfinite(mean(hdr_flip(wide, Grid<vec4>{3, 1}, 67.0))));
}

TEST(Magma, GrowsLighterAllTheWay) {
  Grid<float> ramp{256, 1};
  for (int x = 0; x < 256; ++x) ramp(x, 0) = float(x) / 255.0f;
  const Grid<u8vec4> colors = magma(ramp);
  double before = -1.0;
  for (const u8vec4& color : colors) {
    const double luma = 0.2126 * color.x + 0.7152 * color.y + 0.0722 * color.z;
    EXPECT_GT(luma, before - 0.5);  // half a step of rounding
    before = std::max(before, luma);
  }
  EXPECT_GT(before, 225.0);
}

}  // namespace
}  // namespace parity
