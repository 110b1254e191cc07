#include <algorithm>
#include <array>
#include <cmath>

#include "tests/chart.h"
#include "tests/fluid/cavity_flow.h"

/// The lid-driven cavity at Re 1000 against two published solutions.
namespace parity {
namespace {

struct TableRow {
  double at;
  double ghia;      ///< Ghia, Ghia & Shin 1982, tables I and II: 129^2, second order
  double spectral;  ///< Botella & Peyret 1998, tables 9 and 10: seven digits
};

constexpr std::array<TableRow, 15> u_rows{{{0.9766, 0.65928, 0.6644227},
                                           {0.9688, 0.57492, 0.5808359},
                                           {0.9609, 0.51117, 0.5169277},
                                           {0.9531, 0.46604, 0.4723329},
                                           {0.8516, 0.33304, 0.3372212},
                                           {0.7344, 0.18719, 0.1886747},
                                           {0.6172, 0.05702, 0.0570178},
                                           {0.5000, -0.06080, -0.0620561},
                                           {0.4531, -0.10648, -0.1081999},
                                           {0.2813, -0.27805, -0.2803696},
                                           {0.1719, -0.38289, -0.3885691},
                                           {0.1016, -0.29730, -0.3004561},
                                           {0.0703, -0.22220, -0.2228955},
                                           {0.0625, -0.20196, -0.2023300},
                                           {0.0547, -0.18109, -0.1812881}}};
constexpr std::array<TableRow, 15> v_rows{{{0.9688, -0.21388, -0.2279225},
                                           {0.9609, -0.27669, -0.2936869},
                                           {0.9531, -0.33714, -0.3553213},
                                           {0.9453, -0.39188, -0.4103754},
                                           {0.9063, -0.51550, -0.5264392},
                                           {0.8594, -0.42665, -0.4264545},
                                           {0.8047, -0.31966, -0.3202137},
                                           {0.5000, 0.02526, 0.0257995},
                                           {0.2344, 0.32235, 0.3253592},
                                           {0.2266, 0.33075, 0.3339924},
                                           {0.1563, 0.37095, 0.3769189},
                                           {0.0938, 0.32627, 0.3330442},
                                           {0.0781, 0.30353, 0.3099097},
                                           {0.0703, 0.29012, 0.2962703},
                                           {0.0625, 0.27485, 0.2807056}}};

double largest_error(const FluidState& state, double TableRow::*column) {
  double largest = 0;
  for (const TableRow& row : u_rows)
    largest = std::max(largest, std::abs(centre_u(state, row.at) - row.*column));
  for (const TableRow& row : v_rows)
    largest = std::max(largest, std::abs(centre_v(state, row.at) - row.*column));
  return largest;
}

double tables_apart() {
  double largest = 0;
  for (const auto& rows : {u_rows, v_rows})
    for (const TableRow& row : rows) largest = std::max(largest, std::abs(row.ghia - row.spectral));
  return largest;
}

ChartData cavity_errors(gpu::Context& context) {
  Series ghia{.name = "from Ghia et al. 1982", .points = {}};
  Series spectral{.name = "from Botella & Peyret 1998", .points = {}};
  ChartData data;
  double unconverged = 0;
  for (const CavityRun& run : cavity_runs(context, 1000, {{32, 40}, {64, 60}, {96, 6}, {128, 6}})) {
    const double cells = run.domain.cells.x;
    ghia.points.push_back({cells, largest_error(run.state, &TableRow::ghia), ""});
    spectral.points.push_back({cells, largest_error(run.state, &TableRow::spectral), ""});
    unconverged += run.converged ? 0 : 1;
  }
  data.assertions = {
      {"96^2: off Ghia et al., of the lid's speed", ghia.points[2].y, 0.01},
      {"128^2: off Botella & Peyret, of the lid's speed", spectral.points[3].y, 0.01},
      {"grids on which a projection kept too much divergence", unconverged, 0}};
  data.settings = {{"Reynolds number", "1000"},
                   {"the two tables apart by", std::to_string(tables_apart())}};
  data.series = {ghia, spectral};
  return data;
}

const Registration cavity_chart =
    register_chart({.name = "fluid/cavity",
                    .title = "Lid-driven cavity at Re 1000: largest error of the centrelines",
                    .x = {.label = "cells a side"},
                    .y = {.label = "largest error", .unit = "lid's speed"},
                    .produce = cavity_errors,
                    .fit_slopes = true});

}  // namespace
}  // namespace parity
