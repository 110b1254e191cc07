#include "tools/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tools/xml.h"

namespace parity::tools {
namespace {

const char* const grid_color = "#e4e4e4";
const char* const frame_color = "#444";

std::string superscript(int number) {
  static const std::array<const char*, 10> digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = number < 0 ? "⁻" : "";
  for (char c : std::to_string(std::abs(number))) text += digits[static_cast<std::size_t>(c - '0')];
  return text;
}

std::vector<Tick> decade_ticks(const Scale& scale, int most) {
  const int first = static_cast<int>(std::floor(std::log10(scale.low) + 1e-9));
  const int last = static_cast<int>(std::ceil(std::log10(scale.high) - 1e-9));
  const double span = std::log10(scale.high / scale.low);
  const int every = std::max(1, static_cast<int>(std::ceil(span / most)));
  std::vector<Tick> ticks;
  for (int decade = first; decade <= last; ++decade)
    for (int digit = 1; digit < 10; ++digit) {
      const double value = digit * std::pow(10.0, decade);
      if (value < scale.low * (1 - 1e-9) || value > scale.high * (1 + 1e-9)) continue;
      const bool is_decade = digit == 1 && decade % every == 0;
      const bool between = (span < 2.2 && (digit == 2 || digit == 5)) || span < 0.7;
      if (is_decade || between)
        ticks.push_back({value, tick_label(value)});
      else if (every == 1)
        ticks.push_back({value, ""});
    }
  return ticks;
}

std::vector<Tick> linear_ticks(const Scale& scale, int most) {
  const double raw = (scale.high - scale.low) / most;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  double step = 10 * power;
  for (double factor : {5.0, 2.0, 1.0})
    if (factor * power >= raw * (1 - 1e-9)) step = factor * power;
  std::vector<Tick> ticks;
  for (double k = std::ceil(scale.low / step - 1e-9); k * step <= scale.high + 1e-9 * step; ++k)
    ticks.push_back({k * step, tick_label(k == 0 ? 0.0 : k * step)});
  return ticks;
}

const char* anchor_name(Anchor anchor) {
  if (anchor == Anchor::middle) return "middle";
  return anchor == Anchor::end ? "end" : "start";
}

}  // namespace

double Scale::place(double value) const {
  if (zero_at_low && value == 0) return 0;
  return logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
}

double Scale::value_at(double place) const {
  return logarithmic ? low * std::pow(high / low, place) : low + place * (high - low);
}

std::vector<Tick> Scale::ticks(int most) const {
  std::vector<Tick> ticks = logarithmic ? decade_ticks(*this, most) : linear_ticks(*this, most);
  if (!zero_at_low) return ticks;
  std::erase_if(ticks, [this](const Tick& tick) { return place(tick.value) < 0.06; });
  ticks.push_back({low, "0"});
  return ticks;
}

Scale scale_around(const std::vector<double>& values, bool logarithmic) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (double value : values) {
    if (!std::isfinite(value) || (logarithmic && value <= 0)) continue;
    low = std::min(low, value);
    high = std::max(high, value);
  }
  if (low > high) return logarithmic ? Scale{0.1, 10, true} : Scale{0, 1, false};
  if (logarithmic) {
    const double room = std::max(1.15, std::pow(high / low, 0.04));
    const double least = high / low < 4 ? 2 / std::sqrt(high / low) : 1;
    return {low / std::max(room, least), high * std::max(room, least), true};
  }
  const double room = high > low ? 0.04 * (high - low) : std::max(1.0, std::abs(high)) / 2;
  return {low >= 0 && low < 0.3 * high ? 0 : low - room, high + room, false};
}

std::string tick_label(double value) {
  const double size = std::abs(value);
  if (value == 0) return "0";
  if (size >= 1e-3 && size < 1e5) return fmt::format("{:.5g}", value);
  const int power = static_cast<int>(std::floor(std::log10(size) + 1e-9));
  const double digits = value / std::pow(10.0, power);
  const std::string ten = "10" + superscript(power);
  if (std::abs(digits - 1) < 1e-9) return ten;
  return fmt::format("{:.3g}·{}", digits, ten);
}

std::string three_digits(double value) { return fmt::format("{:.3g}", value); }

std::string series_color(std::size_t i) {
  static const std::array<const char*, 8> colors{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                 "#e69f00", "#56b4e9", "#6a3d9a", "#444444"};
  return colors[i % colors.size()];
}

std::string heat_color(double t) {
  // Viridis at 0, 1/8, ..., 1.
  static constexpr std::array<std::array<double, 3>, 9> stops{{{68, 1, 84},
                                                               {71, 44, 122},
                                                               {59, 81, 139},
                                                               {44, 113, 142},
                                                               {33, 144, 141},
                                                               {39, 173, 129},
                                                               {92, 200, 99},
                                                               {170, 220, 50},
                                                               {253, 231, 37}}};
  const double place = 8 * std::clamp(std::isnan(t) ? 1.0 : t, 0.0, 1.0);
  const auto i = static_cast<std::size_t>(std::min(7.0, std::floor(place)));
  std::array<int, 3> rgb{};
  for (std::size_t c = 0; c < 3; ++c)
    rgb[c] = static_cast<int>(
        std::lround(std::lerp(stops[i][c], stops[i + 1][c], place - static_cast<double>(i))));
  return fmt::format("#{:02x}{:02x}{:02x}", rgb[0], rgb[1], rgb[2]);
}

Svg::Svg(double width, double height) : width_(width), height_(height) {}

void Svg::text(double x, double y, const std::string& text, const TextStyle& style) {
  const std::string turn =
      style.turned == 0
          ? ""
          : fmt::format(" transform=\"rotate({:g} {:.2f} {:.2f})\"", style.turned, x, y);
  body_ += fmt::format(
      "<text x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{:g}\" text-anchor=\"{}\" "
      "fill=\"{}\"{}{}>{}</text>\n",
      x, y, style.size, anchor_name(style.anchor), style.color,
      style.bold ? " font-weight=\"bold\"" : "", turn, xml_escaped(text));
}

void Svg::line(double x1, double y1, double x2, double y2, const std::string& color, double width,
               const std::string& dashes) {
  path({{x1, y1}, {x2, y2}}, color, width, dashes);
}

void Svg::rect(const Area& area, const std::string& fill, const std::string& stroke) {
  body_ += fmt::format(
      "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\" "
      "stroke=\"{}\"/>\n",
      area.left, area.top, area.width, area.height, fill, stroke);
}

void Svg::path(const std::vector<std::pair<double, double>>& points, const std::string& color,
               double width, const std::string& dashes) {
  if (points.size() < 2) return;
  body_ += "<polyline fill=\"none\" points=\"";
  for (const auto& [x, y] : points) body_ += fmt::format("{:.2f},{:.2f} ", x, y);
  body_ +=
      fmt::format("\" stroke=\"{}\" stroke-width=\"{:g}\" stroke-linejoin=\"round\"", color, width);
  if (!dashes.empty()) body_ += fmt::format(" stroke-dasharray=\"{}\"", dashes);
  body_ += "/>\n";
}

void Svg::marker(double x, double y, bool square, const std::string& fill,
                 const std::string& stroke, const std::string& hint, double radius) {
  const std::string shape =
      square ? fmt::format("<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:g}\" height=\"{:g}\"",
                           x - 0.9 * radius, y - 0.9 * radius, 1.8 * radius, 1.8 * radius)
             : fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:g}\"", x, y, radius);
  const std::string name = square ? "rect" : "circle";
  body_ += fmt::format("{} fill=\"{}\" stroke=\"{}\" stroke-width=\"1.5\"><title>{}</title></{}>\n",
                       shape, fill, stroke, xml_escaped(hint), name);
}

void Svg::begin_clip(const Area& area) {
  const int id = clip_count_++;
  body_ += fmt::format(
      "<clipPath id=\"clip{}\"><rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\"/>"
      "</clipPath>\n<g clip-path=\"url(#clip{})\">\n",
      id, area.left, area.top, area.width, area.height, id);
}

void Svg::end_clip() { body_ += "</g>\n"; }

std::string Svg::str() const {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:g}\" height=\"{1:g}\" "
      "viewBox=\"0 0 {0:g} {1:g}\" font-family=\"DejaVu Sans, Verdana, sans-serif\">\n"
      "<rect width=\"{0:g}\" height=\"{1:g}\" fill=\"white\"/>\n{2}</svg>\n",
      width_, height_, body_);
}

double text_width(const std::string& text, double size) {
  const auto letters = std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; });
  return 0.6 * size * static_cast<double>(letters);
}

void draw_axes(Svg& svg, const Area& area, const Scale& x, const Scale& y,
               const std::string& x_label, const std::string& y_label, bool grid) {
  for (const Tick& tick : x.ticks(8)) {
    const double at = area.left + x.place(tick.value) * area.width;
    const bool major = !tick.label.empty();
    if (grid && major) svg.line(at, area.top, at, area.bottom(), grid_color, 1);
    svg.line(at, area.bottom(), at, area.bottom() + (major ? 6 : 3), frame_color, 1);
    if (major) svg.text(at, area.bottom() + 20, tick.label, {.anchor = Anchor::middle});
  }
  for (const Tick& tick : y.ticks(9)) {
    const double at = area.bottom() - y.place(tick.value) * area.height;
    const bool major = !tick.label.empty();
    if (grid && major) svg.line(area.left, at, area.right(), at, grid_color, 1);
    svg.line(area.left - (major ? 6 : 3), at, area.left, at, frame_color, 1);
    if (major) svg.text(area.left - 10, at + 4, tick.label, {.anchor = Anchor::end});
  }
  svg.rect(area, "none", frame_color);
  svg.text(area.left + area.width / 2, area.bottom() + 42, x_label,
           {.size = 13, .anchor = Anchor::middle});
  svg.text(area.left - 66, area.top + area.height / 2, y_label,
           {.size = 13, .anchor = Anchor::middle, .turned = -90});
}

double title_width(const std::string& title) { return 48 + 1.15 * text_width(title, 17); }

void draw_title(Svg& svg, const std::string& title, const std::string& subtitle) {
  svg.text(24, 30, title, {.size = 17, .bold = true});
  svg.text(24, 50, subtitle, {.size = 12, .color = "#555"});
}

void draw_footer(Svg& svg, double top, const std::vector<std::string>& lines) {
  for (std::size_t i = 0; i < lines.size(); ++i)
    svg.text(24, top + 14 * static_cast<double>(i), lines[i], {.size = 10, .color = "#777"});
}

std::vector<std::string> wrapped(const std::string& text, double size, double width) {
  std::vector<std::string> lines(1);
  std::size_t begin = 0;
  while (begin < text.size()) {
    const std::size_t space = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, space - begin);
    const std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
    if (!lines.back().empty() && text_width(longer, size) > width)
      lines.push_back(word);
    else
      lines.back() = longer;
    begin = space + 1;
  }
  return lines;
}

std::string axis_label(const std::string& label, const std::string& unit) {
  return unit.empty() || unit == "1" ? label : label + " (" + unit + ")";
}

std::string column_name(const std::string& label, const std::string& unit) {
  std::string name = label;
  if (!unit.empty() && unit != "1") name += "_" + unit;
  for (char& c : name)
    if (!std::isalnum(static_cast<unsigned char>(c)) && (c & 0x80) == 0) c = '_';
  return name;
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string file_stem(const std::string& name) {
  std::string stem = name;
  for (char& c : stem)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '.' && c != '=') c = '_';
  return stem;
}

}  // namespace parity::tools
