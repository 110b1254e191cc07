#include "cpu_reference/shading/metallic_roughness.h"

#include <cmath>
#include <numbers>

namespace parity::cpu {
namespace {

constexpr double least_roughness = 0.045;
constexpr double least_n_dot_v = 1e-4;
constexpr double dielectric_f0 = 0.04;

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
Triple<Real> inputs_at(const ShadingPoint<Real>& p, std::size_t first) {
  return {p.inputs[first], p.inputs[first + 1], p.inputs[first + 2]};
}

/// The material at the point.
template <class Real>
struct Surface {
  Triple<Real> diffuse;
  Triple<Real> f0;
  Real roughness{};
  Real alpha_squared{};  ///< roughness^4
  Triple<Real> normal;
  Triple<Real> to_eye;
  Real n_dot_v{};
};

/// Normal of the point: interpolated, or turned by the normal map in the frame (T, B, N) of unit N
/// and T and B = cross(N, T) w, which is not made orthogonal; turned over where seen from behind.
template <class Real>
Triple<Real> shading_normal(const Material& m, const ShadingPoint<Real>& p) {
  const Triple<Real> n = normalized(inputs_at(p, shading_input::normal));
  Triple<Real> result = n;
  if (m.normal_texture.texture >= 0) {
    const Triple<Real> t = normalized(inputs_at(p, shading_input::tangent));
    const Triple<Real> b = cross(n, t) * p.inputs[shading_input::handedness];
    const Triple<Real> map = inputs_at(p, shading_input::normal_texture);
    const Real scale{double(m.normal_scale)};
    const Real x = (Real(2.0) * map.x - Real(1.0)) * scale;
    const Real y = (Real(2.0) * map.y - Real(1.0)) * scale;
    const Real z = Real(2.0) * map.z - Real(1.0);
    result = normalized(t * x + b * y + n * z);
  }
  return p.back ? result * Real(-1.0) : result;
}

template <class Real>
Surface<Real> surface_at(const Material& m, const ShadingScene& scene, const ShadingPoint<Real>& p,
                         const Triple<Real>& base) {
  Surface<Real> s;
  const Real metallic = Real(double(m.metallic)) * p.inputs[shading_input::metallic_texture];
  s.roughness = clamped(Real(double(m.roughness)) * p.inputs[shading_input::roughness_texture],
                        least_roughness, 1.0);
  s.alpha_squared = square(square(s.roughness));
  s.diffuse = base * (Real(1.0) - metallic);
  s.f0 = all(rounded<Real>(dielectric_f0)) * (Real(1.0) - metallic) + base * metallic;
  s.normal = shading_normal(m, p);
  s.to_eye = scene.orthographic
                 ? triple<Real>(scene.backward)
                 : normalized(triple<Real>(scene.eye) - inputs_at(p, shading_input::position));
  s.n_dot_v = clamped(magnitude(dot(s.normal, s.to_eye)), least_n_dot_v, 1.0);
  return s;
}

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

/// Source: KHR_lights_punctual, "Range Property"; windowed inverse square.
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

/// f(l, v) times n.l: glTF 2.0, B.3.
template <class Real>
Triple<Real> reflected(const Surface<Real>& s, const Triple<Real>& to_light, const Real& n_dot_l) {
  const Triple<Real> h = normalized(s.to_eye + to_light);
  const Real n_dot_h = clamped(dot(s.normal, h), 0, 1);
  const Real v_dot_h = clamped(dot(s.to_eye, h), 0, 1);
  const Real& a2 = s.alpha_squared;
  const Real one_less = Real(1.0) - a2;
  const Real shape = Real(1.0) - square(n_dot_h) * one_less;
  const Real d = a2 / (rounded<Real>(std::numbers::pi) * square(shape));
  const Real toward_eye = n_dot_l * square_root(square(s.n_dot_v) * one_less + a2);
  const Real toward_light = s.n_dot_v * square_root(square(n_dot_l) * one_less + a2);
  const Real v = Real(0.5) / (toward_eye + toward_light);
  const Real fresnel = fifth_power(clamped(Real(1.0) - v_dot_h, 0, 1));
  const Triple<Real> f = s.f0 + (all(Real(1.0)) - s.f0) * fresnel;
  const Triple<Real> diffuse =
      (all(Real(1.0)) - f) * s.diffuse * rounded<Real>(std::numbers::inv_pi);
  return (diffuse + f * (d * v)) * n_dot_l;
}

/// Part of a uniform environment that the specular lobe sends to the eye. Source: Karis 2014.
template <class Real>
Triple<Real> environment_specular(const Surface<Real>& s) {
  const auto term = [&](double slope, double offset) {
    return s.roughness * rounded<Real>(slope) + rounded<Real>(offset);
  };
  const Real x = term(-1, 1), y = term(-0.0275, 0.0425);
  const Real z = term(-0.572, 1.04), w = term(0.022, -0.04);
  const Real bent = least(square(x), exp2_of(rounded<Real>(-9.28) * s.n_dot_v)) * x + y;
  const Real scale = rounded<Real>(-1.04) * bent + z;
  const Real bias = rounded<Real>(1.04) * bent + w;
  return s.f0 * scale + all(bias);
}

template <class Real>
Triple<Real> lit(const Material& m, const ShadingScene& scene, const ShadingPoint<Real>& p,
                 const Triple<Real>& base) {
  const Surface<Real> s = surface_at(m, scene, p, base);
  Triple<Real> sum =
      triple<Real>(dvec3(m.emission)) * inputs_at(p, shading_input::emission_texture);
  for (const PlacedLight& light : scene.lights) {
    const Incoming<Real> in = incoming(light, inputs_at(p, shading_input::position));
    const Real n_dot_l = clamped(dot(s.normal, in.to_light), 0, 1);
    if (vanishes(n_dot_l) || vanishes(in.irradiance)) continue;
    sum = sum + reflected(s, in.to_light, n_dot_l) *
                    (triple<Real>(dvec3(light.light.color)) * in.irradiance);
  }
  const Triple<Real> ambient = triple<Real>(scene.ambient);
  if (scene.ambient == dvec3(0.0)) return sum;
  const Real occlusion = Real(1.0) + Real(double(m.occlusion_strength)) *
                                         (p.inputs[shading_input::occlusion_texture] - Real(1.0));
  const Triple<Real> specular = environment_specular(s);
  const Triple<Real> seen = s.diffuse * (all(Real(1.0)) - specular) + specular;
  return sum + ambient * seen * occlusion;
}

}  // namespace

ShadingScene shading_scene(const Frame& frame) {
  return {frame.eye, frame.backward, frame.orthographic, dvec3(frame.ambient), frame.lights};
}

template <class Real>
Shaded<Real> shade(const Material& m, const ShadingScene& scene, const ShadingPoint<Real>& p) {
  const Triple<Real> base = triple<Real>(dvec3(m.base_color)) *
                            inputs_at(p, shading_input::base_texture) *
                            inputs_at(p, shading_input::color);
  const Real alpha = Real(double(m.base_color.w)) * p.inputs[shading_input::base_texture + 3] *
                     p.inputs[shading_input::color + 3];
  const Triple<Real> rgb = m.unlit ? base : lit(m, scene, p, base);
  return {{rgb.x, rgb.y, rgb.z}, alpha};
}

template Shaded<double> shade(const Material&, const ShadingScene&, const ShadingPoint<double>&);
template Shaded<Interval> shade(const Material&, const ShadingScene&,
                                const ShadingPoint<Interval>&);

}  // namespace parity::cpu
