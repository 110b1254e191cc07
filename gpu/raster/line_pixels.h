#pragma once

#include <span>
#include <string>
#include <vector>

#include "geometry/raster.h"
#include "gpu/core/context.h"
#include "gpu/core/shader.h"

namespace parity::gpu {

/// Runs a kernel of LineArgs over segments and takes its pixels apart.
///
/// @throws std::invalid_argument  a coordinate is beyond 2^20 or a side over 60,000; `who` begins
/// the
///                                message.
std::vector<std::vector<ivec2>> line_pixels(Context& context, const ShaderCode& code,
                                            std::span<const Segment> segments, const char* who);

}  // namespace parity::gpu
