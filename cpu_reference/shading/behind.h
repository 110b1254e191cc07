#pragma once

#include <array>

#include "cpu_reference/shading/triple.h"
#include "geometry/behind.h"

namespace parity::cpu {

/// The premultiplied colour of a picture where a position is seen: linear between texels and
/// between levels, of which roughness 0.045 asks for the finest and 1 for the coarsest. What is
/// beyond the sides is what is at them; what is beside or behind the eye shows the middle.
///
/// Real is double (the value) or Interval (all that single precision may make of it; exact texels).
///
/// @param origin    to which a device keeps its positions relative, m, world.
/// @param position  relative to it.
///
/// Source: KHR_materials_transmission, KHR_materials_volume, implementation notes.
template <class Real>
std::array<Real, 4> picture_behind(const BehindPicture& picture, const dvec3& origin,
                                   const Triple<Real>& position, const Real& roughness);

}  // namespace parity::cpu
