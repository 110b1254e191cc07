// What charts claim, where no clock is in it: those run with the tests too.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/chart.h"
#include "tests/gpu_context.h"

namespace parity {
namespace {

class ChartClaims : public testing::TestWithParam<std::string> {};

TEST_P(ChartClaims, Hold) {
  const auto chart = std::ranges::find(all_charts(), GetParam(), &Chart::name);
  ASSERT_NE(chart, all_charts().end());
  const ChartData data = chart->produce(test_context());
  ASSERT_FALSE(data.assertions.empty());
  for (const Assertion& a : data.assertions)
    EXPECT_TRUE(a.holds()) << a.what << " is " << a.value << ", bound " << a.bound;
}

std::string test_name(const testing::TestParamInfo<std::string>& chart) {
  std::string name = chart.param;
  std::ranges::replace(name, '/', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(WithoutClock, ChartClaims,
                         testing::Values("sampling/alias_frequency", "sampling/edge_error",
                                         "sampling/filter_error", "sampling/filter_spectra",
                                         "sampling/pattern_edge_error",
                                         "sampling/pattern_smooth_error", "sampling/temporal_error",
                                         "sampling/wagon_wheel", "sampling/zone_plate",
                                         "shading/irradiance_models", "shading/white_furnace",
                                         "texture/anisotropic_quality",
                                         "texture/displacement_error"),
                         test_name);

}  // namespace
}  // namespace parity
