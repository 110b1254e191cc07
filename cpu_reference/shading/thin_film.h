#pragma once

#include <numbers>

#include "cpu_reference/shading/triple.h"

namespace parity::cpu {

/// cos x; a device's own polynomials are right to 2^-22, which is doubled here.
inline double cosine_of(double x) { return std::cos(x); }
inline Interval cosine_of(const Interval& x) {
  const double middle = 0.5 * (x.low + x.high), half = 0.5 * (x.high - x.low) + 0x1p-21;
  if (!std::isfinite(middle) || !(half < 2)) return {-1, 1};
  return {std::cos(middle) - half, std::cos(middle) + half};
}

namespace film {

/// What light loses or gains in phase at a border: half a turn on the way to the denser medium.
inline double phase_shift(double base, double film) { return base < film ? std::numbers::pi : 0; }
inline Interval phase_shift(const Interval& base, const Interval& film) {
  return {base.high < film.low ? std::numbers::pi : 0.0,
          base.low < film.high ? std::numbers::pi : 0.0};
}

template <class Real>
Real reflectance(const Real& inside, const Real& outside) {
  return square((inside - outside) / (inside + outside));
}

template <class Real>
Real schlick(const Real& f0, const Real& cosine) {
  return f0 + (Real(1.0) - f0) * fifth_power(clamped(Real(1.0) - cosine, 0, 1));
}

/// Fourier transforms of the colour matching functions, as Gaussians, in linear Rec. 709; the path
/// is in nm and the phase shift one a channel.
template <class Real>
Triple<Real> sensitivity(const Real& path, const Triple<Real>& shift) {
  const Real phase = path * rounded<Real>(2 * std::numbers::pi * 1e-9);
  const auto lobe = [&](double value, double position, double variance, const Real& turned) {
    const double size = value * std::sqrt(2 * std::numbers::pi * variance) / 1.0685e-7;
    return rounded<Real>(size) * cosine_of(rounded<Real>(position) * phase + turned) *
           exp2_of(square(phase) * rounded<Real>(-variance * std::numbers::log2e));
  };
  const Real x = lobe(5.4856e-13, 1.6810e+06, 4.3278e+09, shift.x) +
                 lobe(9.7470e-14, 2.2399e+06, 4.5282e+09, shift.x);
  const Real y = lobe(4.4201e-13, 1.7953e+06, 9.3046e+09, shift.y);
  const Real z = lobe(5.2481e-13, 2.2084e+06, 6.6121e+09, shift.z);
  const auto channel = [&](double a, double b, double c) {
    return rounded<Real>(a) * x + rounded<Real>(b) * y + rounded<Real>(c) * z;
  };
  return {channel(3.2404542, -1.5371385, -0.4985314), channel(-0.9692660, 1.8760108, 0.0415560),
          channel(0.0556434, -0.2040259, 1.0572252)};
}

}  // namespace film

/// Reflectance of a base with F0 `base` under a film of some index and thickness (nm), for light at
/// this cosine to the normal.
///
/// Source: Belcour & Barla 2017, "A Practical Extension to Microfacet Theory for the Modeling of
/// Varying Iridescence"; KHR_materials_iridescence (unpolarised, Schlick's reflectances).
template <class Real>
Triple<Real> thin_film(double index, const Real& thickness, const Real& cosine,
                       const Triple<Real>& base) {
  const Real t = clamped(thickness / rounded<Real>(0.03), 0, 1);
  const Real eta = Real(1.0) + rounded<Real>(index - 1) * (square(t) * (Real(3.0) - Real(2.0) * t));
  const Real inside =
      square_root(most(Real(1.0) - (Real(1.0) - square(cosine)) / square(eta), Real(0.0)));
  const Real outer = film::schlick(film::reflectance(eta, Real(1.0)), cosine);
  const Real passed = square(Real(1.0) - outer);
  const Real path = Real(2.0) * eta * thickness * inside;
  const auto inner = [&](const Real& f0) {
    const Real root = square_root(clamped(f0, 0, 0.9999));
    const Real base_index = (Real(1.0) + root) / (Real(1.0) - root);
    return std::pair{film::schlick(film::reflectance(base_index, eta), inside),
                     film::phase_shift(base_index, eta) + rounded<Real>(std::numbers::pi)};
  };
  const auto [rx, px] = inner(base.x);
  const auto [ry, py] = inner(base.y);
  const auto [rz, pz] = inner(base.z);
  const Triple<Real> shift{px, py, pz};
  const auto both = [&](const Real& r) { return clamped(outer * r, 1e-5, 0.9999); };
  const auto series = [&](const Real& r) { return passed * r / (Real(1.0) - both(r)); };
  const Triple<Real> rest{series(rx), series(ry), series(rz)};
  const Triple<Real> round{square_root(both(rx)), square_root(both(ry)), square_root(both(rz))};
  Triple<Real> sum = all(outer) + rest;
  Triple<Real> weight = rest - all(Real(1.0) - outer);
  for (int m = 1; m <= 2; ++m) {
    weight = weight * round;
    const Triple<Real> wave = film::sensitivity(Real(double(m)) * path, shift * Real(double(m)));
    sum = sum + weight * wave * Real(2.0);
  }
  return {clamped(sum.x, 0, 1), clamped(sum.y, 0, 1), clamped(sum.z, 0, 1)};
}

}  // namespace parity::cpu
