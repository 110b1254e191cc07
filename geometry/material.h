#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string>

#include "geometry/math.h"

namespace parity {

/// How a material reads one of its textures.
struct TextureUse {
  int texture = -1;            ///< index into Scene::textures, -1: none
  int uv_set = 0;              ///< TEXCOORD_n
  mat3 texture_from_uv{1.0f};  ///< KHR_texture_transform, column vectors (u, v, 1)
};

enum class AlphaMode { opaque, mask, blend };

/// KHR_materials_clearcoat: a thin layer of index 1.5 on top.
struct Clearcoat {
  float factor = 0.0f;
  float roughness = 0.0f;
  float normal_scale = 1.0f;
  TextureUse texture;            ///< R
  TextureUse roughness_texture;  ///< G
  TextureUse normal_texture;
};

/// KHR_materials_specular: of dielectrics.
struct SpecularLobe {
  float strength = 1.0f;
  vec3 color{1.0f};          ///< of the reflection at normal incidence
  TextureUse texture;        ///< A
  TextureUse color_texture;  ///< sRGB
};

/// KHR_materials_sheen: fibres on top.
struct Sheen {
  vec3 color{0.0f};
  float roughness = 0.0f;
  TextureUse color_texture;      ///< sRGB
  TextureUse roughness_texture;  ///< A
};

/// KHR_materials_anisotropy: rougher along the tangent, turned counter-clockwise by the rotation.
struct Anisotropy {
  float strength = 0.0f;
  float rotation = 0.0f;  ///< rad
  TextureUse texture;     ///< RG direction from -1 to 1, B strength
};

/// KHR_materials_iridescence: a thin film.
struct Iridescence {
  float factor = 0.0f;
  float ior = 1.3f;
  float thickness_minimum = 100.0f;  ///< nm
  float thickness_maximum = 400.0f;  ///< nm
  TextureUse texture;                ///< R
  TextureUse thickness_texture;      ///< G: from minimum to maximum
};

/// KHR_materials_transmission, KHR_materials_volume. Without thickness the surface is a thin wall.
struct Transmission {
  float factor = 0.0f;
  float thickness = 0.0f;                                               ///< m, of the object
  float attenuation_distance = std::numeric_limits<float>::infinity();  ///< m
  vec3 attenuation_color{1.0f};  ///< what is left of white light after that distance
  TextureUse texture;            ///< R
  TextureUse thickness_texture;  ///< G
};

/// glTF 2.0 metallic-roughness material. Factors are linear; colours of textures are decoded from
/// sRGB for base colour and emission, read as they are for the others.
struct Material {
  std::string name;
  vec4 base_color{1.0f};
  float metallic = 1.0f;
  float roughness = 1.0f;  ///< perceptual; alpha of the microfacet model is its square
  vec3 emission{0.0f};     ///< emissiveFactor times KHR_materials_emissive_strength
  float normal_scale = 1.0f;
  float occlusion_strength = 1.0f;
  AlphaMode alpha_mode = AlphaMode::opaque;
  float alpha_cutoff = 0.5f;
  bool double_sided = false;
  bool unlit = false;  ///< KHR_materials_unlit: base colour is the output

  TextureUse base_color_texture;
  TextureUse metallic_roughness_texture;  ///< G roughness, B metallic
  TextureUse normal_texture;
  TextureUse occlusion_texture;  ///< R
  TextureUse emission_texture;

  float ior = 1.5f;  ///< KHR_materials_ior; 0: everything is reflected
  SpecularLobe specular;
  Clearcoat clearcoat;
  Sheen sheen;
  Anisotropy anisotropy;
  Iridescence iridescence;
  Transmission transmission;
};

/// What the textures of a material are for.
enum class TextureRole {
  base_color,
  metallic_roughness,
  normal,
  occlusion,
  emission,
  specular,
  specular_color,
  clearcoat,
  clearcoat_roughness,
  clearcoat_normal,
  sheen_color,
  sheen_roughness,
  anisotropy,
  iridescence,
  iridescence_thickness,
  transmission,
  thickness
};
constexpr std::size_t texture_role_count = 17;

namespace detail {
template <class AnyMaterial>
auto textures_of(AnyMaterial& m) {
  return std::array{&m.base_color_texture,
                    &m.metallic_roughness_texture,
                    &m.normal_texture,
                    &m.occlusion_texture,
                    &m.emission_texture,
                    &m.specular.texture,
                    &m.specular.color_texture,
                    &m.clearcoat.texture,
                    &m.clearcoat.roughness_texture,
                    &m.clearcoat.normal_texture,
                    &m.sheen.color_texture,
                    &m.sheen.roughness_texture,
                    &m.anisotropy.texture,
                    &m.iridescence.texture,
                    &m.iridescence.thickness_texture,
                    &m.transmission.texture,
                    &m.transmission.thickness_texture};
}
}  // namespace detail

/// All of them, in the order of TextureRole.
inline std::array<TextureUse*, texture_role_count> textures_of(Material& m) {
  return detail::textures_of(m);
}
inline std::array<const TextureUse*, texture_role_count> textures_of(const Material& m) {
  return detail::textures_of(m);
}

/// Are the colours of such a texture stored in sRGB?
constexpr bool is_srgb(TextureRole role) {
  return role == TextureRole::base_color || role == TextureRole::emission ||
         role == TextureRole::specular_color || role == TextureRole::sheen_color;
}

/// Does light pass through, so that what is behind is seen?
inline bool is_transmissive(const Material& m) { return m.transmission.factor > 0 && !m.unlit; }

/// Is it drawn over what is behind, from far to near? Where a texture says which parts light passes,
/// the others must hide what is behind them: then all is opaque and shows the environment instead.
inline bool is_blended(const Material& m) {
  return m.alpha_mode == AlphaMode::blend ||
         (m.alpha_mode == AlphaMode::opaque && is_transmissive(m) &&
          m.transmission.texture.texture < 0);
}

/// Does shading need tangents?
inline bool needs_tangents(const Material& m) {
  return m.normal_texture.texture >= 0 || m.clearcoat.normal_texture.texture >= 0 ||
         m.anisotropy.strength > 0;
}
/// Whose coordinates they follow.
inline const TextureUse& tangent_texture(const Material& m) {
  if (m.normal_texture.texture >= 0) return m.normal_texture;
  return m.clearcoat.normal_texture.texture >= 0 ? m.clearcoat.normal_texture
                                                 : m.anisotropy.texture;
}

}  // namespace parity
