#include "tools/chart_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <stdexcept>

#include "tests/statistics.h"
#include "tools/plot.h"

namespace parity::tools {
namespace {

constexpr double legend_text_size = 12;
constexpr double plot_width = 620;
constexpr double plot_height = 430;
const char* const front_color = "#b5b5b5";

/// A point by its series and its place in it.
using Place = std::pair<std::size_t, std::size_t>;

std::set<Place> front_of(const Chart& chart, const ChartData& data) {
  std::set<Place> front;
  if (!chart.pareto) return front;
  std::vector<Place> places;
  std::vector<dvec2> points;
  for (std::size_t s = 0; s < data.series.size(); ++s) {
    if (data.series[s].kind == Series::Kind::theory) continue;
    for (std::size_t i = 0; i < data.series[s].points.size(); ++i) {
      places.emplace_back(s, i);
      points.push_back({data.series[s].points[i].x, data.series[s].points[i].y});
    }
  }
  for (std::size_t index : pareto_front(points)) front.insert(places[index]);
  return front;
}

std::optional<PowerFit> fit_of(const Chart& chart, const Series& series) {
  if (!chart.fit_slopes) return std::nullopt;
  std::vector<dvec2> points;
  for (const Point& point : series.points) points.push_back({point.x, point.y});
  try {
    return fit_power(points);
  } catch (const std::invalid_argument&) {
    return std::nullopt;  // too few points that are not 0
  }
}

/// A slope is only written where the points lie on a line.
std::string legend_text(const Chart& chart, const Series& series) {
  const std::optional<PowerFit> fit = fit_of(chart, series);
  if (!fit || !(fit->slope_margin <= 0.5)) return series.name;
  return fmt::format("{}: slope {:.2f} ± {:.2f}", series.name, fit->slope, fit->slope_margin);
}

std::vector<double> values_along(const ChartData& data, double Point::*coordinate) {
  std::vector<double> values;
  for (const Series& series : data.series)
    for (const Point& point : series.points) values.push_back(point.*coordinate);
  return values;
}

/// The drawing and what is known of it.
struct Canvas {
  const Chart& chart;
  const ChartData& data;
  Area area;
  Scale x, y;
  bool names_points = false;  ///< few enough to be told by name
  Svg svg;

  double at_x(double value) const { return area.left + x.place(value) * area.width; }
  double at_y(double value) const { return area.bottom() - y.place(value) * area.height; }
};

bool can_be_drawn(const Canvas& canvas, const Point& point) {
  const bool x_fits = canvas.x.logarithmic ? point.x >= 0 : true;
  const bool y_fits = canvas.y.logarithmic ? point.y >= 0 : true;
  return std::isfinite(point.x) && std::isfinite(point.y) && x_fits && y_fits;
}

bool is_device(const Series& series) {
  return series.name.starts_with("gpu") || series.name.starts_with("device");
}

std::string dashes_of(const Series& series) {
  return series.kind == Series::Kind::theory ? "7 5" : "";
}

void draw_series(Canvas& canvas, std::size_t index, const std::set<Place>& front) {
  const Series& series = canvas.data.series[index];
  const std::string color = series_color(index);
  std::vector<std::pair<double, double>> line;
  for (const Point& point : series.points)
    if (can_be_drawn(canvas, point)) line.emplace_back(canvas.at_x(point.x), canvas.at_y(point.y));
  canvas.svg.path(line, color, 1.8, dashes_of(series));
  if (series.kind == Series::Kind::theory) return;
  for (std::size_t i = 0; i < series.points.size(); ++i) {
    const Point& point = series.points[i];
    if (!can_be_drawn(canvas, point)) continue;
    const double x = canvas.at_x(point.x), y = canvas.at_y(point.y);
    if (front.contains({index, i})) canvas.svg.marker(x, y, false, "none", "#777", "", 8);
    const bool hollow =
        (canvas.x.zero_at_low && point.x == 0) || (canvas.y.zero_at_low && point.y == 0);
    const std::string hint = fmt::format("{} {}: {}, {}", series.name, point.label,
                                         three_digits(point.x), three_digits(point.y));
    canvas.svg.marker(x, y, is_device(series), hollow ? "white" : color, color, hint,
                      is_device(series) ? 5 : 3.5);
    const bool is_place = point.label.starts_with(canvas.chart.x.label + "=");  // the axis says it
    if (canvas.names_points && !point.label.empty() && !is_place)
      canvas.svg.text(x + 7, y - 7, point.label, {.size = 10, .color = "#555"});
  }
}

/// The staircase under which nothing was measured.
void draw_front(Canvas& canvas, const std::set<Place>& front) {
  std::vector<std::pair<double, double>> points;
  for (const auto& [series, i] : front) {
    const Point& point = canvas.data.series[series].points[i];
    if (can_be_drawn(canvas, point))
      points.emplace_back(canvas.at_x(point.x), canvas.at_y(point.y));
  }
  std::ranges::sort(points);
  std::vector<std::pair<double, double>> stairs;
  for (const auto& [x, y] : points) {
    if (!stairs.empty()) stairs.emplace_back(x, stairs.back().second);
    stairs.emplace_back(x, y);
  }
  canvas.svg.path(stairs, front_color, 5);
}

void draw_legend(Canvas& canvas, bool has_front) {
  const double left = canvas.area.right() + 24;
  double y = canvas.area.top + 10;
  for (std::size_t i = 0; i < canvas.data.series.size(); ++i, y += 22) {
    const Series& series = canvas.data.series[i];
    const std::string color = series_color(i);
    canvas.svg.path({{left, y}, {left + 28, y}}, color, 1.8, dashes_of(series));
    if (series.kind == Series::Kind::measured)
      canvas.svg.marker(left + 14, y, is_device(series), color, color, series.name,
                        is_device(series) ? 5 : 3.5);
    canvas.svg.text(left + 36, y + 4, legend_text(canvas.chart, series),
                    {.size = legend_text_size});
  }
  if (!has_front) return;
  canvas.svg.line(left, y, left + 28, y, front_color, 5);
  canvas.svg.marker(left + 14, y, false, "none", "#777", "", 8);
  canvas.svg.text(left + 36, y + 4, "Pareto front", {.size = legend_text_size});
}

/// Values of 0 need the lower edge of the axis for themselves.
Scale scale_of(const std::vector<double>& values, bool logarithmic) {
  Scale scale = scale_around(values, logarithmic);
  scale.zero_at_low = logarithmic && std::ranges::count(values, 0.0) > 0;
  if (scale.zero_at_low) scale.low /= std::pow(scale.high / scale.low, 0.12);
  return scale;
}

std::size_t measured_points(const ChartData& data) {
  std::size_t count = 0;
  for (const Series& series : data.series)
    if (series.kind == Series::Kind::measured) count += series.points.size();
  return count;
}

double legend_width(const Chart& chart, const ChartData& data) {
  double width = text_width("Pareto front", legend_text_size);
  for (const Series& series : data.series)
    width = std::max(width, text_width(legend_text(chart, series), legend_text_size));
  return width + 24 + 36 + 20;
}

std::string settings_text(const ChartData& data) {
  std::string text;
  for (const auto& [name, value] : data.settings)
    text += (text.empty() ? "" : ", ") + name + " " + value;
  return text;
}

std::string assertion_text(const Assertion& assertion) {
  const bool at_most = assertion.relation == Assertion::Relation::at_most;
  return fmt::format("{}: {} {} {} {}", assertion.holds() ? "holds" : "BROKEN", assertion.what,
                     three_digits(assertion.value), at_most ? "at most" : "at least",
                     three_digits(assertion.bound));
}

std::vector<std::string> footer_lines(const ChartData& data, const Provenance& provenance,
                                      double width) {
  std::vector<std::string> lines;
  const auto add = [&](const std::string& text) {
    if (text.empty()) return;
    for (std::string& line : wrapped(text, 10, width)) lines.push_back(std::move(line));
  };
  for (const Assertion& assertion : data.assertions) add(assertion_text(assertion));
  add(settings_text(data));
  add(text_of(provenance));
  return lines;
}

}  // namespace

std::string chart_svg(const Chart& chart, const ChartData& data, const Provenance& provenance) {
  const Area area{.left = 96, .top = 72, .width = plot_width, .height = plot_height};
  const double width = std::max(area.right() + legend_width(chart, data), title_width(chart.title));
  const std::vector<std::string> footer = footer_lines(data, provenance, width - 48);
  const double footer_top = area.bottom() + 72;
  const double legend_bottom = area.top + 22.0 * static_cast<double>(data.series.size() + 2);
  const double height =
      std::max(footer_top + 14 * static_cast<double>(footer.size()), legend_bottom + 20);
  Canvas canvas{.chart = chart,
                .data = data,
                .area = area,
                .x = scale_of(values_along(data, &Point::x), chart.x.logarithmic),
                .y = scale_of(values_along(data, &Point::y), chart.y.logarithmic),
                .names_points = measured_points(data) <= 24,
                .svg = Svg(width, height)};
  const std::set<Place> front = front_of(chart, data);
  draw_title(canvas.svg, chart.title, chart.name);
  draw_axes(canvas.svg, area, canvas.x, canvas.y, axis_label(chart.x.label, chart.x.unit),
            axis_label(chart.y.label, chart.y.unit), true);
  draw_front(canvas, front);
  // The host's discs are smaller than the device's squares: they go on top.
  for (bool device : {true, false})
    for (std::size_t i = 0; i < data.series.size(); ++i)
      if (is_device(data.series[i]) == device) draw_series(canvas, i, front);
  draw_legend(canvas, !front.empty());
  draw_footer(canvas.svg, footer_top, footer);
  return canvas.svg.str();
}

std::string chart_csv(const Chart& chart, const ChartData& data, const Provenance& provenance) {
  const std::set<Place> front = front_of(chart, data);
  std::string csv = fmt::format("# {}: {}\n# {}\n", chart.name, chart.title, text_of(provenance));
  if (!data.settings.empty()) csv += "# " + settings_text(data) + "\n";
  csv += fmt::format("series,label,{},{},pareto\n", column_name(chart.x.label, chart.x.unit),
                     column_name(chart.y.label, chart.y.unit));
  for (std::size_t s = 0; s < data.series.size(); ++s)
    for (std::size_t i = 0; i < data.series[s].points.size(); ++i) {
      const Point& point = data.series[s].points[i];
      csv += fmt::format("{},{},{},{},{}\n", csv_field(data.series[s].name), csv_field(point.label),
                         point.x, point.y, front.contains({s, i}) ? 1 : 0);
    }
  return csv;
}

nlohmann::json chart_json(const Chart& chart, const ChartData& data, const Provenance& provenance) {
  nlohmann::json json = {{"version", 1}, {"name", chart.name}, {"title", chart.title}};
  json["provenance"] = json_of(provenance);
  json["x"] = {{"label", chart.x.label}, {"unit", chart.x.unit}};
  json["y"] = {{"label", chart.y.label}, {"unit", chart.y.unit}};
  json["settings"] = nlohmann::json::object();
  for (const auto& [name, value] : data.settings) json["settings"][name] = value;
  json["series"] = nlohmann::json::array();
  for (const Series& series : data.series) {
    nlohmann::json entry = {{"name", series.name},
                            {"theory", series.kind == Series::Kind::theory},
                            {"points", nlohmann::json::array()}};
    for (const Point& point : series.points)
      entry["points"].push_back({{"x", point.x}, {"y", point.y}, {"label", point.label}});
    if (const std::optional<PowerFit> fit = fit_of(chart, series))
      entry["slope"] = {{"value", fit->slope}, {"margin", fit->slope_margin}};
    json["series"].push_back(entry);
  }
  json["assertions"] = nlohmann::json::array();
  for (const Assertion& assertion : data.assertions)
    json["assertions"].push_back({{"what", assertion.what},
                                  {"value", assertion.value},
                                  {"bound", assertion.bound},
                                  {"at_most", assertion.relation == Assertion::Relation::at_most},
                                  {"holds", assertion.holds()}});
  return json;
}

}  // namespace parity::tools
