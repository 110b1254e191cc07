#include "tools/map_data.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

namespace parity::tools {
namespace {

constexpr int bisections = 6;

bool fails(const Map& map, double value) { return !(value <= map.border); }

/// Nodes of a map: positions and whether it fails there.
class Nodes {
 public:
  Nodes(const Map& map, const std::function<double(double x, double y)>& value, const MapData& data)
      : map_(map), value_(value), data_(data), x_(scale_of(map.x)), y_(scale_of(map.y)) {}

  bool fails_at(ivec2 node) const { return fails(map_, data_.values(node.x, node.y)); }

  /// The border between two neighbours, one of which fails.
  dvec2 border_between(ivec2 a, ivec2 b) const {
    const bool a_fails = fails_at(a);
    dvec2 from = place_of(a), to = place_of(b);
    if (are_consecutive(a, b)) return value_at(glm::mix(from, to, interpolated(a, b)));
    for (int i = 0; i < bisections; ++i) {
      const dvec2 middle = (from + to) / 2.0;
      const double value = value_(x_.value_at(middle.x), y_.value_at(middle.y));
      (fails(map_, value) == a_fails ? from : to) = middle;
    }
    return value_at((from + to) / 2.0);
  }

 private:
  dvec2 value_at(dvec2 place) const { return {x_.value_at(place.x), y_.value_at(place.y)}; }

  /// Whether nothing lies between two neighbours: whole numbers, one apart.
  bool are_consecutive(ivec2 a, ivec2 b) const {
    const bool along_x = a.x != b.x;
    if (!(along_x ? map_.x : map_.y).whole) return false;
    const std::vector<double>& values = along_x ? data_.xs : data_.ys;
    return std::abs(values[static_cast<std::size_t>(along_x ? b.x : b.y)] -
                    values[static_cast<std::size_t>(along_x ? a.x : a.y)]) == 1;
  }

  /// Where the border is from a to b, by their values; in the middle if those say nothing.
  double interpolated(ivec2 a, ivec2 b) const {
    const auto height = [&](double value) { return map_.logarithmic ? std::log(value) : value; };
    const double from = height(data_.values(a.x, a.y)), to = height(data_.values(b.x, b.y));
    const double place = (height(map_.border) - from) / (to - from);
    return place >= 0 && place <= 1 ? place : 0.5;
  }

  dvec2 place_of(ivec2 node) const {
    return {x_.place(data_.xs[static_cast<std::size_t>(node.x)]),
            y_.place(data_.ys[static_cast<std::size_t>(node.y)])};
  }

  const Map& map_;
  const std::function<double(double x, double y)>& value_;
  const MapData& data_;
  Scale x_, y_;
};

/// Border points on the sides of grid squares; each is found once.
class Crossings {
 public:
  Crossings(const Nodes& nodes, int width, int height)
      : nodes_(nodes), right_(width, height), up_(width, height) {}

  std::optional<dvec2> between(ivec2 a, ivec2 b) {
    if (nodes_.fails_at(a) == nodes_.fails_at(b)) return std::nullopt;
    std::optional<dvec2>& known = b.x > a.x ? right_(a.x, a.y) : up_(a.x, a.y);
    if (!known) known = nodes_.border_between(a, b);
    return known;
  }

 private:
  const Nodes& nodes_;
  Grid<std::optional<dvec2>> right_, up_;
};

/// The pieces of the border in one square, side by side around it: two crossings make one piece,
/// four make two.
void add_pieces(Crossings& crossings, ivec2 corner, std::vector<std::pair<dvec2, dvec2>>& pieces) {
  const ivec2 right = corner + ivec2(1, 0), up = corner + ivec2(0, 1), far = corner + ivec2(1, 1);
  std::vector<dvec2> points;
  for (const auto& [a, b] : {std::pair{corner, right}, {right, far}, {up, far}, {corner, up}})
    if (const std::optional<dvec2> point = crossings.between(a, b)) points.push_back(*point);
  for (std::size_t i = 0; i + 1 < points.size(); i += 2)
    pieces.emplace_back(points[i], points[i + 1]);
}

double growth_of(const Stage& stage, std::size_t method, const Setting& setting,
                 gpu::Context& context) {
  try {
    const std::any problem = make_problem(stage, setting, &context);
    return stage.growth(problem, stage.attempt(problem, method, &context));
  } catch (const Unsupported&) {
    return std::numeric_limits<double>::quiet_NaN();
  }
}

const Axis& axis_of(const Stage& stage, const std::string& name) {
  const auto axis = std::ranges::find(stage.axes, name, &Axis::name);
  if (axis == stage.axes.end())
    throw std::invalid_argument("stage " + stage.name + ": no axis " + name + " to map over");
  return *axis;
}

}  // namespace

Scale scale_of(const Axis& axis) { return {axis.low, axis.high, axis.logarithmic}; }

MapData measure_map(const Map& map, const std::function<double(double x, double y)>& value,
                    const std::function<void()>& progress) {
  MapData data{.xs = steps_along(map.x, map.columns), .ys = steps_along(map.y, map.rows)};
  const int width = static_cast<int>(data.xs.size()), height = static_cast<int>(data.ys.size());
  data.values = Grid<double>(width, height);
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) {
      data.values(column, row) =
          value(data.xs[static_cast<std::size_t>(column)], data.ys[static_cast<std::size_t>(row)]);
      progress();
    }
  const Nodes nodes(map, value, data);
  Crossings crossings(nodes, width, height);
  for (int row = 0; row + 1 < height; ++row)
    for (int column = 0; column + 1 < width; ++column)
      add_pieces(crossings, {column, row}, data.border);
  return data;
}

std::vector<Map> maps_of(const Stage& stage) {
  std::vector<Map> maps;
  if (!stage.growth) return maps;
  for (const StageMap& wanted : stage.maps)
    for (std::size_t method = 0; method < stage.methods.size(); ++method) {
      const std::string label = stage.methods[method].label();
      Map map{.name = stage.name + "-" + wanted.x_axis + "-" + wanted.y_axis + "-" + label,
              .title = stage.title + ": " + label,
              .x = axis_of(stage, wanted.x_axis),
              .y = axis_of(stage, wanted.y_axis),
              .value_label = "growth",
              .theory = wanted.theory};
      map.value = [&stage, method, wanted](gpu::Context& context, double x, double y) {
        Setting setting(stage.axes);
        setting.set(wanted.x_axis, x);
        setting.set(wanted.y_axis, y);
        return growth_of(stage, method, setting, context);
      };
      maps.push_back(std::move(map));
    }
  return maps;
}

}  // namespace parity::tools
