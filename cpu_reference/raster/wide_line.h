#pragma once

#include <cstdint>

#include "geometry/raster.h"

namespace parity::cpu {

/// The pixels whose centre lies in a rectangle: the segment from begin to end (px, y down), widened
/// by half the line width to either side, its ends cut square. 1 inside, 0 outside; nothing if the
/// segment has no length.
///
/// @param line_width  px, > 0
/// @throws std::invalid_argument  a number is not finite, or line_width <= 0.
///
/// Source: Vulkan 1.3, "Basic Line Segment Rasterization" (strict lines).
Grid<std::uint8_t> wide_line(vec2 begin, vec2 end, float line_width, int width, int height);

/// How far a point is from the border of that rectangle, px: a device that snaps vertices may
/// decide otherwise where this is small.
double wide_line_border_distance(vec2 begin, vec2 end, float line_width, dvec2 point);

}  // namespace parity::cpu
