#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/raster.h"
#include "gpu/core/context.h"

namespace parity::gpu {

/// The pixels of each segment, found by adding the slope in float and rounding half up. The sum
/// drifts by at most n^2 2^-25 pixel over n steps.
///
/// @param segments  as bresenham.
///
/// Source: notes 1.9.
std::vector<std::vector<ivec2>> dda_line(Context& context, std::span<const Segment> segments);

/// 1 where the centre of a pixel lies in the rectangle of the given width about the segment (y
/// down, pixel centres at 0.5), as Vulkan's rectangular lines; by edge functions.
///
/// @param line_width  pixels, > 0.
/// @throws std::invalid_argument  the segment has no length, or line_width is not positive.
///
/// Source: Vulkan 1.3, "Basic Line Segment Rasterization".
Grid<std::uint8_t> wide_line(Context& context, vec2 begin, vec2 end, float line_width, int width,
                             int height);

/// 1 where the device's own line of width 1 falls.
Grid<std::uint8_t> hardware_line(Context& context, vec2 begin, vec2 end, int width, int height);

}  // namespace parity::gpu
