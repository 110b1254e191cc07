#pragma once

#include <span>
#include <vector>

#include "geometry/transform.h"
#include "gpu/core/context.h"

namespace parity::gpu {

/// Orientations between two unit quaternions at constant angular speed along the shorter arc.
///
/// @param problems  t in 0..1.
/// @return          unit to 2^-21.
///
/// Mathematics: notes 2.7; Eberly 2011: the ratios of sines by their series in cos - 1, so neither
/// the device's arc cosine nor a division by sin 0 enters. Erratum: the notes take the longer arc
/// where the dot product is negative.
std::vector<quat> slerp(Context& context, std::span<const SlerpProblem> problems);

}  // namespace parity::gpu
