#include "tools/plot.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tools/chart_svg.h"
#include "tools/map_data.h"

namespace parity::tools {
namespace {

std::vector<std::string> labels(const Scale& scale, int most) {
  std::vector<std::string> result;
  for (const Tick& tick : scale.ticks(most))
    if (!tick.label.empty()) result.push_back(tick.label);
  return result;
}

using Labels = std::vector<std::string>;

TEST(Scale, TicksAreRound) {
  EXPECT_EQ(labels({0, 10, false}, 5), (Labels{"0", "2", "4", "6", "8", "10"}));
  EXPECT_EQ(labels({-0.13, 0.27, false}, 4), (Labels{"-0.1", "0", "0.1", "0.2"}));
}

TEST(Scale, LogarithmicTicksAreDecades) {
  EXPECT_EQ(labels({1e-7, 1e-3, true}, 8), (Labels{"10⁻⁷", "10⁻⁶", "10⁻⁵", "10⁻⁴", "0.001"}));
  EXPECT_EQ(labels({1, 10, true}, 8), (Labels{"1", "2", "5", "10"}));
}

TEST(Scale, NeverHasManyMoreTicksThanAskedFor) {
  for (double decades = 0.5; decades < 300; decades *= 1.3)
    EXPECT_LE(labels({1e-150, 1e-150 * std::pow(10, decades), true}, 8).size(), 10u) << decades;
}

TEST(Scale, PlaceAndValueAreInverse) {
  const Scale scale{0.1, 1000, true};
  EXPECT_DOUBLE_EQ(scale.place(10), 0.5);
  EXPECT_DOUBLE_EQ(scale.value_at(0.5), 10);
}

TEST(Scale, OneValueOrNoneStillGivesAScale) {
  for (bool logarithmic : {false, true})
    for (const std::vector<double>& values : {std::vector<double>{}, {3.0}, {0.0}, {NAN, 3.0}}) {
      const Scale scale = scale_around(values, logarithmic);
      EXPECT_LT(scale.low, scale.high);
      EXPECT_FALSE(labels(scale, 8).empty());
    }
}

const Provenance provenance{"device", "driver", "host", "0123abc", "2001-02-03"};

TEST(Date, IsThatOfTheEpoch) { EXPECT_EQ(date_of("0"), "1970-01-01"); }

TEST(Chart, CsvHasUnitsAndMarksTheFront) {
  const Chart chart{.name = "a/b",
                    .title = "t",
                    .x = {.label = "time", .unit = "ms"},
                    .y = {.label = "error", .unit = "px"},
                    .pareto = true};
  const ChartData data{.series = {{"cpu, slow", {{1, 4, "n=1"}, {2, 2, "n=2"}, {3, 3, "n=3"}}}}};
  const std::string csv = chart_csv(chart, data, provenance);
  EXPECT_NE(csv.find("series,label,time_ms,error_px,pareto\n\"cpu, slow\",n=1,1,4,1\n\"cpu, "
                     "slow\",n=2,2,2,1\n\"cpu, slow\",n=3,3,3,0\n"),
            std::string::npos);
  EXPECT_NE(csv.find("commit 0123abc; 2001-02-03"), std::string::npos);
}

TEST(Chart, AnAssertionOnNanIsBroken) {
  EXPECT_TRUE((Assertion{"r", 1.25, 1.25}.holds()));
  EXPECT_FALSE((Assertion{"r", NAN, 1.25}.holds()));
  EXPECT_FALSE((Assertion{"r", 1, 2, Assertion::Relation::at_least}.holds()));
}

TEST(Map, BorderIsFoundByBisection) {
  //  y = 1/x; the value is x y, so the border lies on the hyperbola.
  const Map map{.name = "m",
                .title = "t",
                .x = {.name = "x", .low = 0.1, .high = 10, .logarithmic = true},
                .y = {.name = "y", .low = 0.1, .high = 10, .logarithmic = true},
                .value_label = "product",
                .columns = 8,
                .rows = 7,
                .value = {}};
  int evaluations = 0;
  const MapData data = measure_map(
      map, [](double x, double y) { return x * y; }, [&] { ++evaluations; });
  EXPECT_EQ(evaluations, 56);
  ASSERT_GT(data.border.size(), 5u);
  // 1/64 of a side of the grid, which is at most 10^(2/6).
  const double reach = std::pow(10.0, 2.0 / 6 / 64);
  for (const auto& [from, to] : data.border) {
    EXPECT_NEAR(std::log(from.x * from.y), 0, std::log(reach));
    EXPECT_NEAR(std::log(to.x * to.y), 0, std::log(reach));
  }
}

}  // namespace
}  // namespace parity::tools
