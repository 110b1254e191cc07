#pragma once

#include <cstdint>

#include "geometry/grid.h"
#include "geometry/math.h"
#include "gpu/core/context.h"
#include "gpu/core/raster_pipeline.h"

namespace parity::gpu {

/// 1 where the centre of a pixel lies in the rectangle of the given width about the segment (y
/// down, pixel centres at 0.5), as Vulkan's rectangular lines; by edge functions.
///
/// @param line_width  pixels, > 0.
/// @param size        of the picture, px.
/// @throws std::invalid_argument  the segment has no length, or line_width is not positive.
///
/// Source: Vulkan 1.3, "Basic Line Segment Rasterization".
Grid<std::uint8_t> wide_line(Context& context, vec2 begin, vec2 end, float line_width, ivec2 size);

/// 1 where the device's own line of width 1 falls.
///
/// @throws Error  the device does not know that rule.
Grid<std::uint8_t> hardware_line(Context& context, vec2 begin, vec2 end, LineRule rule, ivec2 size);

}  // namespace parity::gpu
