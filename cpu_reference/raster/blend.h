#pragma once

#include <vector>

#include "geometry/raster.h"

namespace parity::cpu {

/// Layers on top of one another, the first at the bottom, on (0, 0, 0, 0). With source s (alpha a)
/// and destination d:
///   over                rgb = a s + (1 - a) d,  alpha = a + (1 - a) d_a
///   over_premultiplied  all = s + (1 - a) d
///   add                 all = s + d
///
/// @throws std::invalid_argument  no layer, or sizes differ.
///
/// Source: notes 1.7 (order matters where colours blend); Porter & Duff 1984.
Grid<dvec4> blend(const std::vector<Grid<vec4>>& layers, BlendMode mode);

/// The same on an RGBA8 target: after every layer the destination is clamped to 0..1 and rounded to
/// the nearest of 256 levels.
///
/// @return  levels / 255.
Grid<dvec4> blend_unorm8(const std::vector<Grid<vec4>>& layers, BlendMode mode);

}  // namespace parity::cpu
