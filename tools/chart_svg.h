#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "tests/chart.h"
#include "tools/provenance.h"

namespace parity::tools {

/// The chart as a picture: series with markers (squares for the device's, whose names begin with
/// "gpu" or "device"), theory dashed, Pareto front, slopes in the legend, settings and provenance
/// below. Values of 0 on a logarithmic axis stand at its lower edge, marked "0".
std::string chart_svg(const Chart& chart, const ChartData& data, const Provenance& provenance);

/// Provenance and settings in lines that begin with #, then one line a point:
/// series, label, x, y, pareto (1 if on the front).
std::string chart_csv(const Chart& chart, const ChartData& data, const Provenance& provenance);

/// Everything, with fitted slopes and assertions.
nlohmann::json chart_json(const Chart& chart, const ChartData& data, const Provenance& provenance);

}  // namespace parity::tools
