#pragma once

#include <algorithm>
#include <cmath>

#include "cpu_reference/shading/triple.h"
#include "geometry/frame.h"

namespace parity::cpu {

/// Where light comes from, and its irradiance on a plane that faces it, for one colour unit.
template <class Real>
struct Incoming {
  Triple<Real> to_light;
  Real irradiance{};
};

/// Source: KHR_lights_punctual, "Inner and Outer Cone Angles".
template <class Real>
Real spot_attenuation(const PlacedLight& light, const Triple<Real>& to_light) {
  const double inner = std::cos(double(light.light.inner_cone_angle));
  const double outer = std::cos(double(light.light.outer_cone_angle));
  const double scale = 1 / std::max(0.001, inner - outer);
  const Real cosine = dot(triple<Real>(-light.direction), to_light);
  const Real linear = clamped(cosine * rounded<Real>(scale) + rounded<Real>(-outer * scale), 0, 1);
  return square(linear);
}

/// What a light sends to a position.
///
/// Source: notes 6.1; KHR_lights_punctual, "Range Property"; windowed inverse square.
/// Erratum: notes 6.1 leave open how a spot's light falls off; it is the square of a ramp of the
/// cosine between the cones.
template <class Real>
Incoming<Real> incoming(const PlacedLight& light, const Triple<Real>& position) {
  const Real intensity{double(light.light.intensity)};
  if (light.light.kind == LightKind::directional)
    return {triple<Real>(-light.direction), intensity};
  const Triple<Real> offset = triple<Real>(light.position) - position;
  const Real squared = length_squared(offset);
  if (vanishes(squared)) return {offset, Real(0.0)};
  Incoming<Real> in{offset * inverse_sqrt(squared), intensity / squared};
  if (std::isfinite(light.light.range)) {
    const Real ratio = squared / Real(double(light.light.range) * double(light.light.range));
    in.irradiance = in.irradiance * clamped(Real(1.0) - square(ratio), 0, 1);
  }
  if (light.light.kind == LightKind::spot)
    in.irradiance = in.irradiance * spot_attenuation(light, in.to_light);
  return in;
}

}  // namespace parity::cpu
