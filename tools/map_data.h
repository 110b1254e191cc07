#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "geometry/grid.h"
#include "tests/chart.h"
#include "tools/plot.h"

namespace parity::tools {

/// A map as it was measured.
struct MapData {
  std::vector<double> xs;  ///< of the columns, rising
  std::vector<double> ys;  ///< of the rows, rising
  Grid<double> values;     ///< value (column, row); row 0 is the lowest y
  /// The border between values up to Map::border and those above (or NaN), in pieces.
  std::vector<std::pair<dvec2, dvec2>> border;
};

/// Measures a map at the nodes of a grid, and finds the border on every side of a grid square that
/// it crosses by bisection, to 1/64 of the side; between consecutive whole numbers by
/// interpolation.
///
/// @param value     Map::value on a device
/// @param progress  called after each evaluation of the grid.
MapData measure_map(const Map& map, const std::function<double(double x, double y)>& value,
                    const std::function<void()>& progress);

/// Where the values of an axis stand, 0 at its low end.
Scale scale_of(const Axis& axis);

/// The maps that follow from a stage's record: one for each of its maps and methods; the value is
/// the growth of the method's answer, and of a method that throws, NaN.
std::vector<Map> maps_of(const Stage& stage);

}  // namespace parity::tools
