#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "cpu_reference/shading/interval.h"
#include "cpu_reference/shading/layers.h"
#include "geometry/frame.h"
#include "geometry/material.h"
#include "geometry/math.h"

namespace parity::cpu {

/// What a fragment's colour depends on, as one list of numbers, so that each can be moved by its
/// error. Textures stand for white (normal maps: (0.5, 0.5, 1); anisotropy: (1, 0.5, 1)) where the
/// material has none.
namespace shading_input {
constexpr std::size_t position = 0;                  ///< 3, m, world
constexpr std::size_t normal = 3;                    ///< 3, world, any length, as interpolated
constexpr std::size_t tangent = 6;                   ///< 3, world, any length, as interpolated
constexpr std::size_t handedness = 9;                ///< of the tangent frame, as interpolated
constexpr std::size_t color = 10;                    ///< 4, vertex colour, linear RGBA
constexpr std::size_t base_texture = 14;             ///< 4, linear RGBA
constexpr std::size_t roughness_texture = 18;        ///< G
constexpr std::size_t metallic_texture = 19;         ///< B
constexpr std::size_t normal_texture = 20;           ///< 3, 0 to 1
constexpr std::size_t occlusion_texture = 23;        ///< R
constexpr std::size_t emission_texture = 24;         ///< 3, linear RGB
constexpr std::size_t specular_texture = 27;         ///< A
constexpr std::size_t specular_color_texture = 28;   ///< 3, linear RGB
constexpr std::size_t clearcoat_texture = 31;        ///< R
constexpr std::size_t coat_roughness_texture = 32;   ///< G
constexpr std::size_t coat_normal_texture = 33;      ///< 3, 0 to 1
constexpr std::size_t sheen_color_texture = 36;      ///< 3, linear RGB
constexpr std::size_t sheen_roughness_texture = 39;  ///< A
constexpr std::size_t anisotropy_texture = 40;       ///< 3, 0 to 1
constexpr std::size_t iridescence_texture = 43;      ///< R
constexpr std::size_t film_thickness_texture = 44;   ///< G
constexpr std::size_t transmission_texture = 45;     ///< R
constexpr std::size_t thickness_texture = 46;        ///< G
constexpr std::size_t count = 47;
}  // namespace shading_input

template <class Real>
struct ShadingPoint {
  std::array<Real, shading_input::count> inputs{};
  bool back = false;                       ///< seen from behind: the normal turns over
  std::array<Real, most_shadows> visible;  ///< share of the light of each of Frame::shadows

  double openness = 1;  ///< share of the light from all around that arrives, but for mirrors

  double scale = 1;  ///< of the object, for what is as thick as it is large

  ShadingPoint() { visible.fill(Real(1.0)); }
};

/// What lights the scene and from where it is seen, in double.
struct ShadingScene {
  dvec3 eye{0.0};
  dvec3 backward{0.0, 0.0, 1.0};
  bool orthographic = false;
  Surroundings around;
  std::vector<PlacedLight> lights;
  std::vector<int> shadow_of_light;                   ///< -1: nothing hides it
  const std::vector<LightShadow>* shadows = nullptr;  ///< may be null
  const Grid<float>* openness = nullptr;              ///< Frame::openness; may be null
  ivec2 size{1};                                      ///< of the picture, px
};
/// Of a material at a pixel.
double openness_at(const ShadingScene& scene, const Material& material, int x, int y);

/// Refers to the frame's environment and shadows.
ShadingScene shading_scene(const Frame& frame);

template <class Real>
struct Shaded {
  std::array<Real, 3> rgb{};  ///< radiance toward the eye, W/(m^2 sr)
  Real alpha{};  ///< of base colour, before the alpha mode has its say; of what transmits: 1 less
                 ///< the part of what is behind that is seen
};

/// Radiance that leaves a point of a surface toward the eye: punctual lights, environment,
/// emission, with all layers of the material. Unlit materials: the base colour. Transmission is
/// approximated: Frame::behind is read where the refracted ray leaves, once; without it what all
/// channels pass alike is blended with what is behind, unrefracted, and the rest shows the
/// environment.
///
/// Real is double (the answer) or Interval (all that single precision may make of it).
///
/// Source: notes 6.1, 6.2; glTF 2.0, Appendix B; KHR_lights_punctual, KHR_materials_*; Heitz 2014
/// (V, height-correlated Smith); Kulla & Conty 2017 and Fdez-Aguera 2019 (several bounces, of
/// metals under punctual lights and of all under the environment).
template <class Real>
Shaded<Real> shade(const Material& material, const ShadingScene& scene,
                   const ShadingPoint<Real>& point);

extern template Shaded<double> shade(const Material&, const ShadingScene&,
                                     const ShadingPoint<double>&);
extern template Shaded<Interval> shade(const Material&, const ShadingScene&,
                                       const ShadingPoint<Interval>&);

}  // namespace parity::cpu
