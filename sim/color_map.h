#pragma once

#include <vector>

#include "geometry/math.h"

namespace parity {

enum class ColorMapKind {
  sequential,  ///< violet over green to yellow
  water,       ///< deep blue to foam
  diverging,   ///< blue over near white to red
};

/// A colour map in which equal steps look equally large: lightness is linear along it (from the
/// middle to both ends of a diverging one), hue and chroma change smoothly; chroma is reduced where
/// a screen has no such colour.
///
/// @param count  at least 2.
/// @return       linear RGB in [0, 1].
///
/// Source: Ottosson 2020, "A perceptual color space for image processing" (Oklab).
std::vector<vec3> color_map(ColorMapKind kind, int count);

/// Lightness, green to red, blue to yellow.
dvec3 oklab_from_linear(const dvec3& rgb);
dvec3 linear_from_oklab(const dvec3& lab);

}  // namespace parity
