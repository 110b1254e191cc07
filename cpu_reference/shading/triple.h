#pragma once

#include "cpu_reference/shading/interval.h"
#include "geometry/math.h"

namespace parity::cpu {

/// Three numbers; GLM's functions do not take Interval.
template <class Real>
struct Triple {
  Real x{}, y{}, z{};
};
template <class Real>
Triple<Real> operator+(const Triple<Real>& a, const Triple<Real>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class Real>
Triple<Real> operator-(const Triple<Real>& a, const Triple<Real>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Real>
Triple<Real> operator*(const Triple<Real>& a, const Real& s) {
  return {a.x * s, a.y * s, a.z * s};
}
template <class Real>
Triple<Real> operator*(const Triple<Real>& a, const Triple<Real>& b) {
  return {a.x * b.x, a.y * b.y, a.z * b.z};
}
template <class Real>
Real dot(const Triple<Real>& a, const Triple<Real>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Real>
Real length_squared(const Triple<Real>& a) {
  return square(a.x) + square(a.y) + square(a.z);
}
template <class Real>
Triple<Real> cross(const Triple<Real>& a, const Triple<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// Zero stays zero.
template <class Real>
Triple<Real> normalized(const Triple<Real>& a) {
  const Real squared = length_squared(a);
  if (vanishes(squared)) return a;
  return a * inverse_sqrt(squared);
}
template <class Real>
Triple<Real> all(const Real& v) {
  return {v, v, v};
}
template <class Real>
Triple<Real> triple(const dvec3& v) {
  return {rounded<Real>(v.x), rounded<Real>(v.y), rounded<Real>(v.z)};
}
template <class Real>
Real largest(const Triple<Real>& a) {
  return most(most(a.x, a.y), a.z);
}
template <class Real>
Real smallest(const Triple<Real>& a) {
  return least(least(a.x, a.y), a.z);
}

}  // namespace parity::cpu
