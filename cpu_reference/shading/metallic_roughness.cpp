#include "cpu_reference/shading/metallic_roughness.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "cpu_reference/shading/layers.h"
#include "cpu_reference/shading/punctual_light.h"
#include "cpu_reference/shading/thin_film.h"

namespace parity::cpu {
namespace {

namespace input = shading_input;

constexpr double least_roughness = 0.045;
constexpr double least_sheen_roughness = 0.2;

template <class Real>
Triple<Real> inputs_at(const ShadingPoint<Real>& p, std::size_t first) {
  return {p.inputs[first], p.inputs[first + 1], p.inputs[first + 2]};
}

/// Unit vectors at a point, all turned over where it is seen from behind.
template <class Real>
struct TangentFrame {
  Triple<Real> tangent, bitangent, normal;

  /// B = cross(N, T) w is not made orthogonal.
  explicit TangentFrame(const ShadingPoint<Real>& p) {
    const Real side{p.back ? -1.0 : 1.0};
    normal = normalized(inputs_at(p, input::normal)) * side;
    tangent = normalized(inputs_at(p, input::tangent)) * side;
    bitangent = cross(normal, tangent) * (p.inputs[input::handedness] * side);
  }

  Triple<Real> mapped(const ShadingPoint<Real>& p, std::size_t texture, double scale) const {
    const Triple<Real> map = inputs_at(p, texture);
    const Real x = (Real(2.0) * map.x - Real(1.0)) * Real(scale);
    const Real y = (Real(2.0) * map.y - Real(1.0)) * Real(scale);
    const Real z = Real(2.0) * map.z - Real(1.0);
    return normalized(tangent * x + bitangent * y + normal * z);
  }
};

template <class Real>
Real facing(const Triple<Real>& normal, const Triple<Real>& to_eye) {
  return clamped(magnitude(dot(normal, to_eye)), least_n_dot_v, 1.0);
}

/// F0 under a film: Schlick's curve from there goes through what the film reflects toward the eye.
/// Once a point, not once a light. Source: KHR_materials_iridescence.
template <class Real>
Triple<Real> filmed(const Material& m, const ShadingPoint<Real>& p, const Real& n_dot_v,
                    const Triple<Real>& f0, const Real& f90) {
  if (!(m.iridescence.factor > 0)) return f0;
  const double least = m.iridescence.thickness_minimum, most = m.iridescence.thickness_maximum;
  const Real thickness =
      Real(least) + rounded<Real>(most - least) * p.inputs[input::film_thickness_texture];
  const Triple<Real> film = thin_film(double(m.iridescence.ior), thickness, n_dot_v, f0);
  const Real grazing = fifth_power(Real(1.0) - n_dot_v);
  const Real part = Real(double(m.iridescence.factor)) * p.inputs[input::iridescence_texture];
  const auto channel = [&](const Real& seen, const Real& bare) {
    const Real straight = clamped((seen - f90 * grazing) / (Real(1.0) - grazing), 0, 1);
    return bare + (straight - bare) * part;
  };
  return {channel(film.x, f0.x), channel(film.y, f0.y), channel(film.z, f0.z)};
}

/// Diffuse albedo and reflectances: a dielectric and a metal, mixed. What is under the border of
/// the dielectric keeps its colour: it gets what the strongest channel leaves.
/// Source: glTF 2.0, B.2; KHR_materials_specular, _ior.
template <class Real>
void add_base(const Material& m, const ShadingPoint<Real>& p, const Triple<Real>& base,
              Surface<Real>& s) {
  const Real metallic = Real(double(m.metallic)) * p.inputs[input::metallic_texture];
  const Real body = Real(1.0) - metallic;
  const double index = m.ior;
  const double border = m.ior > 0 ? std::pow((index - 1) / (index + 1), 2) : 1.0;
  const Real weight = Real(double(m.specular.strength)) * p.inputs[input::specular_texture];
  const Triple<Real> tinted =
      triple<Real>(dvec3(m.specular.color)) * inputs_at(p, input::specular_color_texture);
  const auto dielectric = [&](const Real& tint) {
    return least(rounded<Real>(border) * tint, Real(1.0)) * weight;
  };
  s.diffuse = base * body;
  const Triple<Real> plastic = filmed(
      m, p, s.n_dot_v, {dielectric(tinted.x), dielectric(tinted.y), dielectric(tinted.z)}, weight);
  s.body_f0 = largest(plastic);
  s.body_f90 = weight;
  s.plastic_f0 = plastic;
  s.metal = m.metallic > 0;
  s.f0 = plastic * body;
  if (s.metal) {
    s.metal_f0 = filmed(m, p, s.n_dot_v, base, Real(1.0));
    s.f0 = s.f0 + s.metal_f0 * metallic;
  }
  s.f90 = weight * body + metallic;
  s.roughness =
      clamped(Real(double(m.roughness)) * p.inputs[input::roughness_texture], least_roughness, 1.0);
  s.alpha_squared = square(square(s.roughness));
  s.metallic = metallic;
}

/// Source: KHR_materials_anisotropy.
template <class Real>
void add_anisotropy(const Material& m, const ShadingPoint<Real>& p, const TangentFrame<Real>& frame,
                    Surface<Real>& s) {
  if (!(m.anisotropy.strength > 0)) return;
  const Triple<Real> texel = inputs_at(p, input::anisotropy_texture);
  const Real x = Real(2.0) * texel.x - Real(1.0), y = Real(2.0) * texel.y - Real(1.0);
  const Real c = rounded<Real>(std::cos(double(m.anisotropy.rotation)));
  const Real t = rounded<Real>(std::sin(double(m.anisotropy.rotation)));
  const Real strength = Real(double(m.anisotropy.strength)) * texel.z;
  s.stretched = true;
  s.along = normalized(frame.tangent * (c * x - t * y) + frame.bitangent * (t * x + c * y));
  s.across = cross(s.normal, s.along);
  s.alpha_across = square(s.roughness);
  s.alpha_along = s.alpha_across + (Real(1.0) - s.alpha_across) * square(strength);
}

/// Source: KHR_materials_clearcoat.
template <class Real>
void add_coat(const Material& m, const ShadingPoint<Real>& p, const TangentFrame<Real>& frame,
              Surface<Real>& s) {
  if (!(m.clearcoat.factor > 0)) return;
  s.coated = true;
  s.coat_normal = m.clearcoat.normal_texture.texture >= 0
                      ? frame.mapped(p, input::coat_normal_texture, m.clearcoat.normal_scale)
                      : frame.normal;
  s.coat_roughness =
      clamped(Real(double(m.clearcoat.roughness)) * p.inputs[input::coat_roughness_texture],
              least_roughness, 1.0);
  s.coat_n_dot_v = facing(s.coat_normal, s.to_eye);
  const Real fresnel =
      rounded<Real>(coat_f0) + rounded<Real>(1 - coat_f0) * fifth_power(Real(1.0) - s.coat_n_dot_v);
  s.coat_weight = Real(double(m.clearcoat.factor)) * p.inputs[input::clearcoat_texture] * fresnel;
}

/// Source: KHR_materials_sheen.
template <class Real>
void add_sheen(const Material& m, const ShadingPoint<Real>& p, Surface<Real>& s) {
  if (m.sheen.color == vec3(0)) return;
  s.fibrous = true;
  s.sheen = triple<Real>(dvec3(m.sheen.color)) * inputs_at(p, input::sheen_color_texture);
  s.sheen_roughness =
      clamped(Real(double(m.sheen.roughness)) * p.inputs[input::sheen_roughness_texture],
              least_sheen_roughness, 1.0);
  s.sheen_albedo = tabulated_sheen(albedo_table(), s.n_dot_v, s.sheen_roughness);
}

/// Source: KHR_materials_transmission; KHR_materials_volume (Beer's law over the thickness).
template <class Real>
void add_transmission(const Material& m, const ShadingPoint<Real>& p, Surface<Real>& s) {
  if (!(m.transmission.factor > 0)) return;
  s.transmits = true;
  s.see_through = is_blended(m);
  s.thick = m.transmission.thickness > 0;
  s.index = Real(m.ior > 0 ? double(m.ior) : 1.0);
  s.transmission = Real(double(m.transmission.factor)) * p.inputs[input::transmission_texture];
  s.tint = s.diffuse;
  s.depth = Real(double(m.transmission.thickness)) * rounded<Real>(p.scale) *
            p.inputs[input::thickness_texture];
  if (!s.thick || std::isinf(m.transmission.attenuation_distance)) return;
  const auto left = [&](float color) {
    const double exponent =
        std::log2(std::max(double(color), 1e-6)) / double(m.transmission.attenuation_distance);
    return exp2_of(rounded<Real>(exponent) * s.depth);
  };
  const vec3& color = m.transmission.attenuation_color;
  s.tint = s.tint * Triple<Real>{left(color.x), left(color.y), left(color.z)};
}

template <class Real>
Surface<Real> surface_at(const Material& m, const ShadingScene& scene, const ShadingPoint<Real>& p,
                         const Triple<Real>& base) {
  const TangentFrame<Real> frame(p);
  Surface<Real> s;
  s.normal = m.normal_texture.texture >= 0 ? frame.mapped(p, input::normal_texture, m.normal_scale)
                                           : frame.normal;
  s.to_eye = scene.orthographic
                 ? triple<Real>(scene.backward)
                 : normalized(triple<Real>(scene.eye) - inputs_at(p, input::position));
  s.n_dot_v = facing(s.normal, s.to_eye);
  s.position = inputs_at(p, input::position) - triple<Real>(scene.eye);
  add_base(m, p, base, s);
  s.albedo = tabulated_albedo(albedo_table(), s.n_dot_v, s.roughness);
  add_anisotropy(m, p, frame, s);
  add_coat(m, p, frame, s);
  add_sheen(m, p, s);
  add_transmission(m, p, s);
  return s;
}

bool is_dark(const Surroundings& around) {
  return around.light == nullptr && around.uniform == dvec3(0.0);
}

template <class Real>
Shaded<Real> lit(const Material& m, const ShadingScene& scene, const ShadingPoint<Real>& p,
                 const Triple<Real>& base) {
  const Surface<Real> s = surface_at(m, scene, p, base);
  Triple<Real> sum = triple<Real>(dvec3(m.emission)) * inputs_at(p, input::emission_texture);
  if (s.coated) sum = sum * (Real(1.0) - s.coat_weight);
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const PlacedLight& light = scene.lights[i];
    Incoming<Real> in = incoming(light, inputs_at(p, input::position));
    if (scene.shadows != nullptr && scene.shadow_of_light[i] >= 0)
      in.irradiance = in.irradiance * p.visible[std::size_t(scene.shadow_of_light[i])];
    const Real n_dot_l = clamped(dot(s.normal, in.to_light), 0, 1);
    if (vanishes(n_dot_l) || vanishes(in.irradiance)) continue;
    sum = sum + reflected(s, in.to_light, n_dot_l) *
                    (triple<Real>(dvec3(light.light.color)) * in.irradiance);
  }
  Real alpha{1.0};
  if (!is_dark(scene.around) || s.transmits) {
    const Real occlusion = Real(1.0) + Real(double(m.occlusion_strength)) *
                                           (p.inputs[input::occlusion_texture] - Real(1.0));
    const Surrounded<Real> around = surrounded(s, scene.around, p.openness);
    sum = sum + around.radiance * occlusion;
    if (s.transmits) {
      alpha = Real(1.0) - around.open;
      sum = {sum.x / alpha, sum.y / alpha, sum.z / alpha};
    }
  }
  return {{sum.x, sum.y, sum.z}, alpha};
}

}  // namespace

ShadingScene shading_scene(const Frame& frame) {
  const EnvironmentLight* light = frame.environment ? &*frame.environment : nullptr;
  ShadingScene scene{frame.eye,          frame.backward,
                     frame.orthographic, {dvec3(frame.ambient), light, nullptr, frame.eye},
                     frame.lights,       std::vector<int>(frame.lights.size(), -1)};
  for (std::size_t i = 0; i < frame.shadows.size(); ++i)
    scene.shadow_of_light[std::size_t(frame.shadows[i].light)] = int(i);
  if (!frame.shadows.empty()) scene.shadows = &frame.shadows;
  if (!frame.openness.empty()) scene.openness = &frame.openness;
  if (frame.behind) scene.around.behind = &*frame.behind;
  scene.size = {frame.options.width, frame.options.height};
  return scene;
}

double openness_at(const ShadingScene& scene, const Material& material, int x, int y) {
  if (scene.openness == nullptr || is_blended(material)) return 1;
  const Grid<float>& g = *scene.openness;
  return double(g(std::min(int(std::int64_t(x) * g.width() / scene.size.x), g.width() - 1),
                  std::min(int(std::int64_t(y) * g.height() / scene.size.y), g.height() - 1)));
}

template <class Real>
Shaded<Real> shade(const Material& m, const ShadingScene& scene, const ShadingPoint<Real>& p) {
  const Triple<Real> base = triple<Real>(dvec3(m.base_color)) * inputs_at(p, input::base_texture) *
                            inputs_at(p, input::color);
  Real alpha =
      Real(double(m.base_color.w)) * p.inputs[input::base_texture + 3] * p.inputs[input::color + 3];
  if (m.unlit) return {{base.x, base.y, base.z}, alpha};
  Shaded<Real> shaded = lit(m, scene, p, base);
  if (is_transmissive(m) && m.alpha_mode == AlphaMode::opaque) alpha = Real(1.0);
  shaded.alpha = shaded.alpha * alpha;
  return shaded;
}

template Shaded<double> shade(const Material&, const ShadingScene&, const ShadingPoint<double>&);
template Shaded<Interval> shade(const Material&, const ShadingScene&,
                                const ShadingPoint<Interval>&);

}  // namespace parity::cpu
