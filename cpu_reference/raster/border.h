#pragma once

#include <vector>

#include "cpu_reference/raster/elements.h"
#include "cpu_reference/raster/rasterize.h"
#include "cpu_reference/raster/surface_bound.h"

namespace parity::cpu {

/// Where a device may cover other samples of an element than the reference: along the border of
/// lines, of points, and of triangles that are clipped, whose new corners a device snaps once more.
///
/// Source: conformance 1.3 ("coverage, unknown driver"; "line, rectangular"), 1.4.
class ElementBorder {
 public:
  /// @param error  of the element; borrowed.
  ElementBorder(const PlacedDraw& draw, std::uint32_t element, const Planes& planes,
                const ElementError& error, const Frame& frame);

  /// The pixels that hold the border.
  const PixelBox& box() const { return box_; }

  /// Whether the point of the window is so near the border that either answer is right.
  bool in_doubt(double x, double y) const;

 private:
  /// One side: its distance in pixels, positive inside, as a plane, and what more than an edge's
  /// error it may be off.
  struct Side {
    dvec3 distance{0.0};
    double slack = 0;
  };

  void add_side(const dvec3& plane, double slack);
  void add_triangle(const PlacedDraw& draw, std::uint32_t element, const Planes& planes);
  void add_line(const std::array<vec4, 3>& clip);
  void add_point(vec4 clip);
  void grow_box(dvec2 window);

  const ElementError& error_;
  int width_;
  int height_;
  std::vector<Side> sides_;
  PixelBox box_;
};

/// Whether anything of an element's border is ever in doubt.
bool has_doubtful_border(const PlacedDraw& draw, std::uint32_t element);

}  // namespace parity::cpu
