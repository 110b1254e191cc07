#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>

#include "geometry/gltf_parse.h"

namespace parity::gltf {
namespace {

using Value = tinygltf::Value;

const Value* find(const tinygltf::ExtensionMap& extensions, const std::string& name) {
  const auto found = extensions.find(name);
  return found == extensions.end() ? nullptr : &found->second;
}

float number_value(const Value& object, const std::string& key, float otherwise) {
  return object.Has(key) ? float(object.Get(key).GetNumberAsDouble()) : otherwise;
}

vec4 vector_value(const Value& object, const std::string& key, vec4 otherwise) {
  if (!object.Has(key)) return otherwise;
  const Value& array = object.Get(key);
  for (int i = 0; i < 4 && std::size_t(i) < array.ArrayLen(); ++i)
    otherwise[i] = float(array.Get(i).GetNumberAsDouble());
  return otherwise;
}

/// Translation after rotation after scale; the rotation takes u to v's negative, as v points down.
/// Source: KHR_texture_transform; its first example (the lower left quadrant) tells the direction.
mat3 uv_matrix(const Value& transform) {
  const vec4 offset = vector_value(transform, "offset", vec4(0));
  const vec4 scale = vector_value(transform, "scale", vec4(1));
  const float angle = number_value(transform, "rotation", 0);
  const float c = std::cos(angle), s = std::sin(angle);
  return mat3(vec3(c * scale.x, -s * scale.x, 0), vec3(s * scale.y, c * scale.y, 0),
              vec3(offset.x, offset.y, 1));
}

TextureUse texture_use(int texture, int uv_set, const Value* transform) {
  TextureUse use{.texture = texture, .uv_set = uv_set, .texture_from_uv = mat3(1.0f)};
  if (!transform) return use;
  use.texture_from_uv = uv_matrix(*transform);
  use.uv_set = int(number_value(*transform, "texCoord", float(use.uv_set)));
  return use;
}

template <typename Info>
TextureUse texture_use(const Info& info) {
  return texture_use(info.index, info.texCoord, find(info.extensions, "KHR_texture_transform"));
}

/// The same from an extension of the material, which arrives as a bare value.
TextureUse texture_use(const Value& object, const std::string& key) {
  if (!object.Has(key)) return {};
  const Value& info = object.Get(key);
  const Value* transform = nullptr;
  if (info.Has("extensions") && info.Get("extensions").Has("KHR_texture_transform"))
    transform = &info.Get("extensions").Get("KHR_texture_transform");
  return texture_use(info.Get("index").GetNumberAsInt(), int(number_value(info, "texCoord", 0)),
                     transform);
}

float perceived_brightness(vec3 c) {
  return std::sqrt(0.299f * c.x * c.x + 0.587f * c.y * c.y + 0.114f * c.z * c.z);
}

/// Solves for the metalness at which a metallic-roughness material has this diffuse and specular.
/// Source: KHR_materials_pbrSpecularGlossiness, "Converting Between Materials" of its examples.
float solve_metallic(float diffuse, float specular, float one_minus_specular_strength) {
  constexpr float dielectric = 0.04f;
  if (specular < dielectric) return 0;
  const float b =
      diffuse * one_minus_specular_strength / (1 - dielectric) + specular - 2 * dielectric;
  const float c = dielectric - specular;
  const float d = std::max(b * b - 4 * dielectric * c, 0.0f);
  return std::clamp((-b + std::sqrt(d)) / (2 * dielectric), 0.0f, 1.0f);
}

/// Factors only: the specular-glossiness texture has no counterpart in this model.
void apply_specular_glossiness(const Value& extension, Material& material) {
  const vec4 diffuse = vector_value(extension, "diffuseFactor", vec4(1));
  const vec3 specular = vec3(vector_value(extension, "specularFactor", vec4(1)));
  const bool has_texture = extension.Has("specularGlossinessTexture");
  const float one_minus_strength = 1 - std::max({specular.x, specular.y, specular.z});
  material.roughness = 1 - number_value(extension, "glossinessFactor", 1);
  material.base_color_texture = texture_use(extension, "diffuseTexture");
  material.metallic_roughness_texture = {};
  if (has_texture) {
    material.metallic = 0;
    material.base_color = diffuse;
    return;
  }
  const float metallic = solve_metallic(perceived_brightness(vec3(diffuse)),
                                        perceived_brightness(specular), one_minus_strength);
  const vec3 from_diffuse =
      vec3(diffuse) * (one_minus_strength / 0.96f / std::max(1 - metallic, 1e-6f));
  const vec3 from_specular = (specular - vec3(0.04f * (1 - metallic))) / std::max(metallic, 1e-6f);
  const vec3 mixed = glm::mix(from_diffuse, from_specular, metallic * metallic);
  material.metallic = metallic;
  material.base_color = vec4(glm::clamp(mixed, vec3(0), vec3(1)), diffuse.w);
}

vec3 color_value(const Value& object, const std::string& key, vec3 otherwise) {
  return vec3(vector_value(object, key, vec4(otherwise, 0)));
}

void read_clearcoat(const Value& from, Clearcoat& to) {
  to.factor = number_value(from, "clearcoatFactor", 0);
  to.roughness = number_value(from, "clearcoatRoughnessFactor", 0);
  to.texture = texture_use(from, "clearcoatTexture");
  to.roughness_texture = texture_use(from, "clearcoatRoughnessTexture");
  to.normal_texture = texture_use(from, "clearcoatNormalTexture");
  if (from.Has("clearcoatNormalTexture"))
    to.normal_scale = number_value(from.Get("clearcoatNormalTexture"), "scale", 1);
}

void read_specular(const Value& from, SpecularLobe& to) {
  to.strength = number_value(from, "specularFactor", 1);
  to.color = color_value(from, "specularColorFactor", vec3(1));
  to.texture = texture_use(from, "specularTexture");
  to.color_texture = texture_use(from, "specularColorTexture");
}

void read_sheen(const Value& from, Sheen& to) {
  to.color = color_value(from, "sheenColorFactor", vec3(0));
  to.roughness = number_value(from, "sheenRoughnessFactor", 0);
  to.color_texture = texture_use(from, "sheenColorTexture");
  to.roughness_texture = texture_use(from, "sheenRoughnessTexture");
}

void read_anisotropy(const Value& from, Anisotropy& to) {
  to.strength = number_value(from, "anisotropyStrength", 0);
  to.rotation = number_value(from, "anisotropyRotation", 0);
  to.texture = texture_use(from, "anisotropyTexture");
}

void read_iridescence(const Value& from, Iridescence& to) {
  to.factor = number_value(from, "iridescenceFactor", 0);
  to.ior = number_value(from, "iridescenceIor", 1.3f);
  to.thickness_minimum = number_value(from, "iridescenceThicknessMinimum", 100);
  to.thickness_maximum = number_value(from, "iridescenceThicknessMaximum", 400);
  to.texture = texture_use(from, "iridescenceTexture");
  to.thickness_texture = texture_use(from, "iridescenceThicknessTexture");
}

void read_volume(const Value& from, Transmission& to) {
  to.thickness = number_value(from, "thicknessFactor", 0);
  to.attenuation_distance = number_value(from, "attenuationDistance", to.attenuation_distance);
  to.attenuation_color = color_value(from, "attenuationColor", vec3(1));
  to.thickness_texture = texture_use(from, "thicknessTexture");
}

void read_extensions(const tinygltf::ExtensionMap& extensions, Material& m) {
  const auto read = [&](const char* name, auto&& action) {
    if (const Value* from = find(extensions, std::string("KHR_materials_") + name)) action(*from);
  };
  read("ior", [&](const Value& from) { m.ior = number_value(from, "ior", 1.5f); });
  read("specular", [&](const Value& from) { read_specular(from, m.specular); });
  read("clearcoat", [&](const Value& from) { read_clearcoat(from, m.clearcoat); });
  read("sheen", [&](const Value& from) { read_sheen(from, m.sheen); });
  read("anisotropy", [&](const Value& from) { read_anisotropy(from, m.anisotropy); });
  read("iridescence", [&](const Value& from) { read_iridescence(from, m.iridescence); });
  read("volume", [&](const Value& from) { read_volume(from, m.transmission); });
  read("transmission", [&](const Value& from) {
    m.transmission.factor = number_value(from, "transmissionFactor", 0);
    m.transmission.texture = texture_use(from, "transmissionTexture");
  });
}

}  // namespace

Material convert_material(const tinygltf::Material& from) {
  Material material;
  const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
  material.name = from.name;
  for (int i = 0; i < 4; ++i) material.base_color[i] = float(pbr.baseColorFactor[std::size_t(i)]);
  material.metallic = float(pbr.metallicFactor);
  material.roughness = float(pbr.roughnessFactor);
  for (int i = 0; i < 3 && from.emissiveFactor.size() == 3; ++i)
    material.emission[i] = float(from.emissiveFactor[std::size_t(i)]);
  if (const Value* strength = find(from.extensions, "KHR_materials_emissive_strength"))
    material.emission *= number_value(*strength, "emissiveStrength", 1);
  material.normal_scale = float(from.normalTexture.scale);
  material.occlusion_strength = float(from.occlusionTexture.strength);
  if (from.alphaMode == "MASK") material.alpha_mode = AlphaMode::mask;
  if (from.alphaMode == "BLEND") material.alpha_mode = AlphaMode::blend;
  material.alpha_cutoff = float(from.alphaCutoff);
  material.double_sided = from.doubleSided;
  material.unlit = find(from.extensions, "KHR_materials_unlit") != nullptr;
  material.base_color_texture = texture_use(pbr.baseColorTexture);
  material.metallic_roughness_texture = texture_use(pbr.metallicRoughnessTexture);
  material.normal_texture = texture_use(from.normalTexture);
  material.occlusion_texture = texture_use(from.occlusionTexture);
  material.emission_texture = texture_use(from.emissiveTexture);
  read_extensions(from.extensions, material);
  if (const Value* extension = find(from.extensions, "KHR_materials_pbrSpecularGlossiness"))
    apply_specular_glossiness(*extension, material);
  return material;
}

}  // namespace parity::gltf
