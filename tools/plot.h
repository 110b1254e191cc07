#pragma once

#include <string>
#include <vector>

#include "tools/provenance.h"

/// What charts and maps share: scales, ticks, and an SVG that is written piece by piece.
namespace parity::tools {

struct Tick {
  double value = 0;
  std::string label;  ///< empty: a minor tick
};

/// Where values stand along an axis.
struct Scale {
  double low = 0;
  double high = 1;
  bool logarithmic = false;
  bool zero_at_low =
      false;  ///< logarithmic: the value 0 stands at the lower edge and is marked there

  /// 0 at low, 1 at high; beyond them outside.
  double place(double value) const;
  double value_at(double place) const;
  /// Labelled round numbers, at most about `most`, and minor ticks between.
  std::vector<Tick> ticks(int most) const;
};

/// The scale that shows all of `values`, with room around them; only positive ones if logarithmic.
Scale scale_around(const std::vector<double>& values, bool logarithmic);

/// "0.01", "250", "10⁻⁷": as short as it can be read.
std::string tick_label(double value);
/// Three significant digits: "0.0123", "1.5e-07".
std::string three_digits(double value);

/// Colour i of a set that colour-blind people can tell apart. Source: Okabe & Ito 2008.
std::string series_color(std::size_t i);
/// Dark to light for 0 to 1, perceptually ordered: viridis, van der Walt & Smith 2015.
std::string heat_color(double t);

/// Rectangle in the picture, y down.
struct Area {
  double left = 0, top = 0, width = 0, height = 0;
  double right() const { return left + width; }
  double bottom() const { return top + height; }
};

enum class Anchor { start, middle, end };

struct TextStyle {
  double size = 12;
  Anchor anchor = Anchor::start;
  std::string color = "#222";
  bool bold = false;
  double turned = 0;  ///< degrees, clockwise
};

/// A picture that grows by appending; text is escaped.
class Svg {
 public:
  Svg(double width, double height);

  void text(double x, double y, const std::string& text, const TextStyle& style = {});
  void line(double x1, double y1, double x2, double y2, const std::string& color, double width,
            const std::string& dashes = "");
  void rect(const Area& area, const std::string& fill, const std::string& stroke = "none");
  /// A polyline; an empty dash pattern is a full line.
  void path(const std::vector<std::pair<double, double>>& points, const std::string& color,
            double width, const std::string& dashes = "");
  /// A disc or a square, with a hint that shows when pointed at.
  void marker(double x, double y, bool square, const std::string& fill, const std::string& stroke,
              const std::string& hint, double radius = 4);
  /// What follows is cut off at this area, until end_clip.
  void begin_clip(const Area& area);
  void end_clip();

  std::string str() const;

 private:
  std::string body_;
  double width_, height_;
  int clip_count_ = 0;
};

/// Width of a text as it is likely to be drawn; never much less.
double text_width(const std::string& text, double size);

/// Frame, grid lines, ticks and labels of both axes around `area`.
void draw_axes(Svg& svg, const Area& area, const Scale& x, const Scale& y,
               const std::string& x_label, const std::string& y_label, bool grid);

/// Width of a picture that has room for its title.
double title_width(const std::string& title);
/// Title and subtitle, top left.
void draw_title(Svg& svg, const std::string& title, const std::string& subtitle);
/// Settings and provenance in small print, line by line from `top` down.
void draw_footer(Svg& svg, double top, const std::vector<std::string>& lines);
/// Lines that are no wider than `width`, broken at spaces.
std::vector<std::string> wrapped(const std::string& text, double size, double width);

/// "label (unit)", without unit 1.
std::string axis_label(const std::string& label, const std::string& unit);
/// "time_ms", fit for the header of a CSV column.
std::string column_name(const std::string& label, const std::string& unit);
/// A field of CSV, quoted where it must be.
std::string csv_field(const std::string& text);
/// "raster/edge_coverage" to "raster_edge_coverage"
std::string file_stem(const std::string& name);

}  // namespace parity::tools
