#pragma once

#include <array>

#include "cpu_reference/shading/triple.h"
#include "geometry/environment.h"
#include "geometry/grid.h"
#include "geometry/math.h"

/// Tables and environments read between their nodes. Real is double (the value) or Interval (all
/// that single precision may make of it; exact tables).
namespace parity::cpu {

/// Slope, offset and mean of the table of directional albedos (geometry/albedo_table.h).
template <class Real>
Triple<Real> tabulated_albedo(const Grid<vec4>& table, const Real& cosine, const Real& roughness);

/// Albedo of a white sheen.
template <class Real>
Real tabulated_sheen(const Grid<vec4>& table, const Real& cosine, const Real& roughness);

/// What a mirror of that roughness shows in a direction of any length.
template <class Real>
Triple<Real> mirrored(const EnvironmentLight& light, const Triple<Real>& direction,
                      const Real& roughness);

/// Irradiance over pi on a surface with that unit normal; not below 0.
template <class Real>
Triple<Real> irradiance_over_pi(const EnvironmentLight& light, const Triple<Real>& normal);

}  // namespace parity::cpu
