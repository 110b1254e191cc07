// What charts and maps claim, where no clock is in it: those run with the tests too.
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

class MapBorders : public testing::TestWithParam<std::string> {};

TEST_P(MapBorders, LieOnTheory) {
  // The value crosses the border within a fiftieth of the map's height of the line, where all of
  // that is on the map.
  const auto map = std::ranges::find(all_maps(), GetParam(), &Map::name);
  ASSERT_NE(map, all_maps().end());
  const double reach = 0.02 * (map->y.high - map->y.low);
  int judged = 0;
  for (const TheoryLine& line : map->theory)
    for (int i = 1; i < 12; ++i) {
      const double x = map->x.low + (map->x.high - map->x.low) * i / 12, y = line.y(x);
      if (!(y - reach > map->y.low && y + reach < map->y.high)) continue;
      const auto is_over = [&](double at) {
        return map->value(test_context(), x, at) > map->border;
      };
      EXPECT_NE(is_over(y - reach), is_over(y + reach)) << line.label << " at " << x;
      ++judged;
    }
  EXPECT_GT(judged, 2);
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

INSTANTIATE_TEST_SUITE_P(Maps, MapBorders,
                         testing::Values("ode/stability_explicit_euler", "ode/stability_midpoint",
                                         "ode/stability_rk4", "texture/level_of_detail"),
                         test_name);

}  // namespace
}  // namespace parity
