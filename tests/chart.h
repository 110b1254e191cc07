#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "gpu/core/context.h"
#include "tests/setting.h"
#include "tests/stage.h"

/// Charts and maps that are not drawn from one stage's record: measured by a function of their own.
namespace parity {

struct Point {
  double x = 0;
  double y = 0;
  std::string label = {};  ///< what gave this point: "spp=16"
};

/// One line of a chart.
struct Series {
  std::string name;
  std::vector<Point> points;
  enum class Kind { measured, theory } kind = Kind::measured;  ///< theory is drawn dashed
};

/// A claim that a chart holds its measurement to.
struct Assertion {
  std::string what;  ///< "device time / bare draw"
  double value = 0;
  double bound = 0;
  enum class Relation { at_most, at_least } relation = Relation::at_most;
  /// NaN never holds.
  bool holds() const { return relation == Relation::at_most ? value <= bound : value >= bound; }
};

struct ChartData {
  std::vector<Series> series;
  std::vector<Assertion> assertions = {};
  std::vector<std::pair<std::string, std::string>> settings = {};  ///< printed under the chart
};

struct ChartAxis {
  std::string label = {};
  std::string unit = "1";
  bool logarithmic = true;
};

/// Registered by a file of tests/<chapter>/; `parity chart` draws it.
struct Chart {
  std::string name;  ///< "raster/depth_resolution"; may be that of a stage: then both are drawn
  std::string title;
  ChartAxis x = {};
  ChartAxis y = {};
  std::function<ChartData(gpu::Context&)> produce;
  bool pareto = false;      ///< x and y are both costs: mark the Pareto front
  bool fit_slopes = false;  ///< write log-log slopes into the legend
};

/// A value over two axes as a heat map, with the border at which it crosses `border` found by
/// bisection, and theory's line over it.
struct Map {
  std::string name;
  std::string title;
  Axis x = {};
  Axis y = {};
  std::string value_label;
  std::string value_unit = "1";
  bool logarithmic = true;  ///< colours by the logarithm of the value
  double border = 1;        ///< above: failed
  int columns = 24;
  int rows = 18;
  std::function<double(gpu::Context&, double x, double y)> value;
  std::vector<TheoryLine> theory = {};
};

/// @throws std::logic_error  that name is there already, or there is no function.
Registration register_chart(Chart chart);
Registration register_map(Map map);

/// Sorted by name.
std::span<const Chart> all_charts();
std::span<const Map> all_maps();

}  // namespace parity
