#include "cpu_reference/raster/border.h"

#include <algorithm>
#include <cmath>

namespace parity::cpu {
namespace {

bool inside_view(const vec4& p) {
  return std::abs(p.x) <= p.w && std::abs(p.y) <= p.w && p.z >= 0 && p.z <= p.w;
}

}  // namespace

bool has_doubtful_border(const PlacedDraw& draw, std::uint32_t element) {
  if (draw.primitive->topology != Topology::triangles) return true;
  const std::array<vec4, 3> clip = clip_corners(draw, element);
  return !std::all_of(clip.begin(), clip.end(), inside_view);
}

ElementBorder::ElementBorder(const PlacedDraw& draw, std::uint32_t element, const Planes& planes,
                             const ElementError& error, const Frame& frame)
    : error_(error),
      width_(frame.options.width),
      height_(frame.options.height),
      box_{width_, height_, 0, 0} {
  const std::array<vec4, 3> clip = clip_corners(draw, element);
  switch (draw.primitive->topology) {
    case Topology::points:
      add_point(clip[0]);
      break;
    case Topology::lines:
      add_line(clip);
      break;
    case Topology::triangles:
      add_triangle(draw, element, planes);
      break;
  }
}

/// A side where a function that is affine in the window is 0; none where it never is.
void ElementBorder::add_side(const dvec3& plane, double slack) {
  const double gradient = std::hypot(plane.x, plane.y);
  if (gradient > 0 && std::isfinite(gradient)) sides_.push_back({plane / gradient, slack});
}

/// The pixels that reach within two pixels of a point.
void ElementBorder::grow_box(dvec2 window) {
  if (!std::isfinite(window.x) || !std::isfinite(window.y)) window = {0.0, 0.0};
  const dvec2 limit{double(width_), double(height_)};
  const dvec2 low = glm::clamp(window - 2.0, dvec2(0.0), limit);
  const dvec2 high = glm::clamp(window + 2.0, dvec2(0.0), limit);
  box_.left = std::min(box_.left, int(low.x));
  box_.top = std::min(box_.top, int(low.y));
  box_.right = std::max(box_.right, int(std::ceil(high.x)));
  box_.bottom = std::max(box_.bottom, int(std::ceil(high.y)));
}

void ElementBorder::add_triangle(const PlacedDraw& draw, std::uint32_t element,
                                 const Planes& planes) {
  for (const dvec3& weight : planes.weight) add_side(weight, 0);
  // A depth of 0 or 1 has its float error beside that of the place.
  const double depth_slack = 0x1p-20 / std::hypot(planes.depth.x, planes.depth.y);
  add_side(planes.depth, depth_slack);
  add_side(dvec3(0, 0, 1) - planes.depth, depth_slack);
  add_side(planes.one_over_w, 0);
  const std::array<vec4, 3> clip = clip_corners(draw, element);
  if (std::any_of(clip.begin(), clip.end(), [](const vec4& p) { return !(p.w > 0); })) {
    box_ = {0, 0, width_, height_};
    return;
  }
  for (const vec4& p : clip) grow_box(window_of(dvec4(p), width_, height_));
}

/// The ends of a line that the viewport cuts may stand anywhere within a pixel of it: a device may
/// clip the line or its rectangle.
void ElementBorder::add_line(const std::array<vec4, 3>& clip) {
  const ClippedLine line = clip_line(clip[0], clip[1]);
  if (line.empty) return;
  const dvec2 a = window_of(line.ends[0], width_, height_);
  const dvec2 b = window_of(line.ends[1], width_, height_);
  const double length = glm::distance(a, b);
  if (!(length > 0)) return;
  const dvec2 along = (b - a) / length;
  const dvec2 across{-along.y, along.x};
  add_side({along, -glm::dot(along, a)}, line.at[0] > 0 ? 1 : 0);
  add_side({-along, glm::dot(along, b)}, line.at[1] < 1 ? 1 : 0);
  add_side({across, 0.5 - glm::dot(across, a)}, 0);
  add_side({-across, 0.5 + glm::dot(across, a)}, 0);
  grow_box(a);
  grow_box(b);
}

/// A point outside of the view may be dropped or drawn in part: where it is, is in doubt.
void ElementBorder::add_point(vec4 clip) {
  if (!(clip.w > 0)) return;
  const dvec2 p = window_of(dvec4(clip), width_, height_);
  const double slack = inside_view(clip) ? 0 : 0.5;
  add_side({1, 0, 0.5 - p.x}, slack);
  add_side({-1, 0, 0.5 + p.x}, slack);
  add_side({0, 1, 0.5 - p.y}, slack);
  add_side({0, -1, 0.5 + p.y}, slack);
  grow_box(p);
}

bool ElementBorder::in_doubt(double x, double y) const {
  const double edge = error_.edge(x, y);
  bool near = false;
  for (const Side& side : sides_) {
    const double distance = at(side.distance, x, y);
    if (distance < -edge - side.slack) return false;
    near |= distance <= edge + side.slack;
  }
  return near;
}

}  // namespace parity::cpu
