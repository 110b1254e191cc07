#include "tools/map_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace parity::tools {
namespace {

constexpr double plot_width = 560;
constexpr double plot_height = 420;
constexpr double largest_range = 1e12;  ///< of values that colours show
const char* const not_a_number_color = "#9a9a9a";

std::string theory_color(std::size_t i) { return i == 0 ? "#ff4422" : series_color(i + 3); }

Scale color_scale(const Map& map, const MapData& data) {
  std::vector<double> values = data.values.values();
  values.push_back(map.border);
  if (!map.logarithmic) return scale_around(values, false);
  double low = map.border, high = map.border;
  for (double value : values)
    if (std::isfinite(value) && value > 0) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  low = std::max(low, map.border / largest_range);
  high = std::min(high, map.border * largest_range);
  if (high / low < 10) return {low / 3, high * 3, true};
  return {low, high, true};
}

std::string color_of(double value, const Scale& scale) {
  if (std::isnan(value)) return not_a_number_color;
  if (scale.logarithmic && value <= 0) return heat_color(0);
  return heat_color(scale.place(value));
}

/// Cells end half-way to the next node, at the axis's ends at the node itself.
std::vector<double> cell_edges(const std::vector<double>& nodes, const Scale& scale) {
  std::vector<double> edges{0};
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i)
    edges.push_back((scale.place(nodes[i]) + scale.place(nodes[i + 1])) / 2);
  edges.push_back(1);
  return edges;
}

void draw_cells(Svg& svg, const Area& area, const Map& map, const MapData& data,
                const Scale& colors) {
  const std::vector<double> xs = cell_edges(data.xs, scale_of(map.x));
  const std::vector<double> ys = cell_edges(data.ys, scale_of(map.y));
  for (std::size_t row = 0; row < data.ys.size(); ++row)
    for (std::size_t column = 0; column < data.xs.size(); ++column) {
      const double value = data.values(static_cast<int>(column), static_cast<int>(row));
      const std::string color = color_of(value, colors);
      svg.rect({.left = area.left + xs[column] * area.width,
                .top = area.bottom() - ys[row + 1] * area.height,
                .width = (xs[column + 1] - xs[column]) * area.width,
                .height = (ys[row + 1] - ys[row]) * area.height},
               color, color);
    }
}

std::pair<double, double> position(const Area& area, const Map& map, dvec2 at) {
  return {area.left + scale_of(map.x).place(at.x) * area.width,
          area.bottom() - scale_of(map.y).place(at.y) * area.height};
}

void draw_border(Svg& svg, const Area& area, const Map& map, const MapData& data) {
  for (const auto& [color, width] : {std::pair{"black", 6.0}, {"white", 4.0}})
    for (const auto& [from, to] : data.border)
      svg.path({position(area, map, from), position(area, map, to)}, color, width);
}

void draw_theory(Svg& svg, const Area& area, const Map& map) {
  const Scale x = scale_of(map.x);
  for (std::size_t i = 0; i < map.theory.size(); ++i) {
    std::vector<std::pair<double, double>> points;
    for (int k = 0; k <= 200; ++k) {
      const double at = x.value_at(k / 200.0);
      const double y = map.theory[i].y(at);
      const bool drawable = std::isfinite(y) && (!map.y.logarithmic || y > 0);
      if (drawable) points.push_back(position(area, map, {at, y}));
    }
    svg.path(points, theory_color(i), 2, "9 5");
  }
}

void draw_color_bar(Svg& svg, const Area& bar, const Map& map, const Scale& colors) {
  constexpr int slices = 128;
  for (int i = 0; i < slices; ++i) {
    const std::string color = heat_color((i + 0.5) / slices);
    svg.rect(
        {bar.left, bar.bottom() - (i + 1) * bar.height / slices, bar.width, bar.height / slices},
        color, color);
  }
  svg.rect(bar, "none", "#444");
  for (const Tick& tick : colors.ticks(8)) {
    const double y = bar.bottom() - colors.place(tick.value) * bar.height;
    if (tick.label.empty()) continue;
    svg.line(bar.right(), y, bar.right() + 5, y, "#444", 1);
    svg.text(bar.right() + 9, y + 4, tick.label);
  }
  const double border = bar.bottom() - colors.place(map.border) * bar.height;
  svg.line(bar.left - 4, border, bar.right(), border, "black", 4.5);
  svg.line(bar.left - 4, border, bar.right(), border, "white", 2.5);
  svg.text(bar.left, bar.top - 10, axis_label(map.value_label, map.value_unit), {.size = 13});
}

/// Below the plot, entries side by side; the next line begins where they do not fit.
double draw_legend(Svg& svg, double left, double top, double width, const Map& map,
                   const MapData& data) {
  double x = left, y = top;
  const auto entry = [&](const std::string& label, const std::string& color, bool is_theory) {
    const double needed = 44 + text_width(label, 12) + 20;
    if (x > left && x + needed > left + width) {
      x = left;
      y += 20;
    }
    if (!is_theory) svg.line(x, y - 4, x + 34, y - 4, "black", 6);
    svg.line(x, y - 4, x + 34, y - 4, color, is_theory ? 2 : 4, is_theory ? "9 5" : "");
    svg.text(x + 42, y, label);
    x += needed;
  };
  if (!data.border.empty())
    entry(map.value_label + " = " + tick_label(map.border) + ", measured", "white", false);
  for (std::size_t i = 0; i < map.theory.size(); ++i)
    entry(map.theory[i].label, theory_color(i), true);
  const auto is_nan = [](double value) { return std::isnan(value); };
  if (std::ranges::any_of(data.values, is_nan)) {
    svg.rect({x, y - 11, 34, 13}, not_a_number_color);
    svg.text(x + 42, y, "no answer");
  }
  return y;
}

}  // namespace

std::string map_svg(const Map& map, const MapData& data, const Provenance& provenance) {
  const Area area{.left = 96, .top = 84, .width = plot_width, .height = plot_height};
  const Area bar{.left = area.right() + 34, .top = area.top, .width = 22, .height = area.height};
  const double bar_label = text_width(axis_label(map.value_label, map.value_unit), 13);
  const double width =
      std::max(bar.left + std::max(bar_label, bar.width + 80) + 20, title_width(map.title));
  const std::vector<std::string> footer = wrapped(text_of(provenance), 10, width - 48);
  // The legend's lines are known once it is drawn: draw it into a picture of its own first.
  Svg trial(width, 0);
  const double legend_top = area.bottom() + 70;
  const double legend_bottom =
      draw_legend(trial, area.left, legend_top, width - area.left - 20, map, data);
  Svg svg(width, legend_bottom + 24 + 14 * static_cast<double>(footer.size()));
  const Scale colors = color_scale(map, data);
  draw_title(svg, map.title, map.name);
  svg.begin_clip(area);
  draw_cells(svg, area, map, data, colors);
  draw_border(svg, area, map, data);
  draw_theory(svg, area, map);
  svg.end_clip();
  draw_axes(svg, area, scale_of(map.x), scale_of(map.y), axis_label(map.x.name, map.x.unit),
            axis_label(map.y.name, map.y.unit), false);
  draw_color_bar(svg, bar, map, colors);
  draw_legend(svg, area.left, legend_top, width - area.left - 20, map, data);
  draw_footer(svg, legend_bottom + 24, footer);
  return svg.str();
}

std::string map_csv(const Map& map, const MapData& data, const Provenance& provenance) {
  std::string csv = fmt::format("# {}: {}\n# {}\n", map.name, map.title, text_of(provenance));
  csv += fmt::format("{},{},{},failed\n", column_name(map.x.name, map.x.unit),
                     column_name(map.y.name, map.y.unit),
                     column_name(map.value_label, map.value_unit));
  for (std::size_t row = 0; row < data.ys.size(); ++row)
    for (std::size_t column = 0; column < data.xs.size(); ++column) {
      const double value = data.values(static_cast<int>(column), static_cast<int>(row));
      csv += fmt::format("{},{},{},{}\n", data.xs[column], data.ys[row], value,
                         value <= map.border ? 0 : 1);
    }
  return csv;
}

nlohmann::json map_json(const Map& map, const MapData& data, const Provenance& provenance) {
  nlohmann::json json = {{"version", 1}, {"name", map.name}, {"title", map.title}};
  json["provenance"] = json_of(provenance);
  json["x"] = {{"name", map.x.name}, {"unit", map.x.unit}, {"values", data.xs}};
  json["y"] = {{"name", map.y.name}, {"unit", map.y.unit}, {"values", data.ys}};
  json["value"] = {{"name", map.value_label}, {"unit", map.value_unit}, {"border", map.border}};
  json["values"] = nlohmann::json::array();
  for (int row = 0; row < data.values.height(); ++row) {
    std::vector<double> line;
    for (int column = 0; column < data.values.width(); ++column)
      line.push_back(data.values(column, row));
    json["values"].push_back(line);
  }
  json["border"] = nlohmann::json::array();
  for (const auto& [from, to] : data.border)
    json["border"].push_back({{from.x, from.y}, {to.x, to.y}});
  json["theory"] = nlohmann::json::array();
  for (const TheoryLine& line : map.theory) {
    nlohmann::json points = nlohmann::json::array();
    for (double x : data.xs) points.push_back({x, line.y(x)});
    json["theory"].push_back({{"label", line.label}, {"points", points}});
  }
  return json;
}

}  // namespace parity::tools
