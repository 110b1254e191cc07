#pragma once

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
};

}  // namespace parity
