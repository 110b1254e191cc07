#include "gpu/raster/scene_buffers.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

#include "geometry/albedo_table.h"
#include "geometry/color.h"
#include "geometry/mip_pyramid.h"

namespace parity::gpu {
namespace {

/// Buffers of pools: few, yet far below what any device allows (128 MiB).
std::size_t pool_bytes(const Context& context) {
  return std::size_t(
      std::min<std::uint64_t>(context.info().max_buffer_bytes, std::uint64_t(64) << 20));
}

bool is_there(const Scene& scene, const TextureUse& use) {
  return use.texture >= 0 &&
         !scene.images[std::size_t(scene.textures[std::size_t(use.texture)].image)].empty();
}

std::uint32_t wrap_code(Wrap wrap) {
  switch (wrap) {
    case Wrap::repeat:
      return 0;
    case Wrap::mirrored_repeat:
      return 1;
    default:
      return 2;
  }
}

std::uint32_t sampler_flags(const Sampler& sampler) {
  std::uint32_t flags = wrap_code(sampler.wrap_u) << texture_wrap_u_shift |
                        wrap_code(sampler.wrap_v) << texture_wrap_v_shift;
  if (sampler.wrap_u == Wrap::mirror_clamp_to_edge) flags |= texture_mirror_once_u;
  if (sampler.wrap_v == Wrap::mirror_clamp_to_edge) flags |= texture_mirror_once_v;
  if (sampler.mag == Filter::linear) flags |= texture_linear_mag;
  if (sampler.min == Filter::linear) flags |= texture_linear_min;
  if (sampler.mip == Filter::nearest) flags |= texture_mip_nearest;
  if (sampler.mip == Filter::linear) flags |= texture_mip_linear;
  if (sampler.mag == Filter::linear && sampler.min == Filter::linear &&
      sampler.mip == Filter::linear)
    flags |= std::uint32_t(std::clamp(sampler.max_anisotropy, 1, 16)) << texture_anisotropy_shift;
  return flags;
}

SceneMaterial without_textures(const Material& m) {
  SceneMaterial result{};
  result.base_color = m.base_color;
  result.emission = m.emission;
  result.metallic = m.metallic;
  result.roughness = m.roughness;
  result.normal_scale = m.normal_scale;
  result.occlusion_strength = m.occlusion_strength;
  result.alpha_cutoff = m.alpha_cutoff;
  if (m.alpha_mode == AlphaMode::mask) result.flags |= material_flag_mask;
  if (m.alpha_mode == AlphaMode::blend) result.flags |= material_flag_alpha;
  if (is_blended(m)) result.flags |= material_flag_blend;
  if (m.double_sided) result.flags |= material_flag_double_sided;
  if (m.unlit) result.flags |= material_flag_unlit;
  return result;
}

bool is_layered(const Material& m) {
  return m.ior != 1.5f || m.specular.strength != 1 || m.specular.color != vec3(1) ||
         m.clearcoat.factor > 0 || m.sheen.color != vec3(0) || m.anisotropy.strength > 0 ||
         m.transmission.factor > 0 || m.iridescence.factor > 0;
}

vec3 log2_attenuation(const Transmission& t) {
  vec3 result{0.0f};
  for (int i = 0; i < 3 && std::isfinite(t.attenuation_distance); ++i)
    result[i] = float(std::log2(std::max(double(t.attenuation_color[i]), 1e-6)) /
                      double(t.attenuation_distance));
  return result;
}

SceneLayers layers_of(const Material& m) {
  const double index = m.ior;
  const double border = m.ior > 0 ? std::pow((index - 1) / (index + 1), 2) : 1.0;
  return {.specular_color = vec3(dvec3(m.specular.color) * border),
          .specular = m.specular.strength,
          .clearcoat = m.clearcoat.factor,
          .clearcoat_roughness = m.clearcoat.roughness,
          .clearcoat_normal_scale = m.clearcoat.normal_scale,
          .sheen_roughness = m.sheen.roughness,
          .sheen_color = m.sheen.color,
          .anisotropy = m.anisotropy.strength,
          .anisotropy_direction = vec2(dvec2(std::cos(double(m.anisotropy.rotation)),
                                             std::sin(double(m.anisotropy.rotation)))),
          .index = m.ior > 0 ? m.ior : 1.0f,
          .transmission = m.transmission.factor,
          .thickness = m.transmission.thickness,
          .log2_attenuation = log2_attenuation(m.transmission),
          .has_coat_normal = m.clearcoat.normal_texture.texture >= 0 ? 1u : 0u,
          .iridescence = m.iridescence.factor,
          .film_index = m.iridescence.ior,
          .film_thickness = vec2(m.iridescence.thickness_minimum, m.iridescence.thickness_maximum)};
}

/// Slot of a uv set within a material; a new one if it is not there yet.
std::uint32_t slot_of(std::vector<int>& sets, int uv_set) {
  const auto found = std::find(sets.begin(), sets.end(), uv_set);
  const auto slot = std::uint32_t(found - sets.begin());
  if (found == sets.end()) sets.push_back(uv_set);
  return slot;
}

std::vector<float> srgb_table() {
  std::vector<float> table(256);
  for (std::size_t code = 0; code < 256; ++code)
    table[code] = float(linear_from_srgb(double(code) / 255.0));
  return table;
}

std::vector<bool> images_with_mips(const Scene& scene) {
  std::vector<bool> mipmapped(scene.images.size());
  for (const Texture& texture : scene.textures)
    if (texture.sampler.mip) mipmapped[std::size_t(texture.image)] = true;
  return mipmapped;
}

}  // namespace

SceneBuffers::SceneBuffers(Context& context, const Scene& scene, std::vector<LevelRange> levels)
    : indices_(pool_bytes(context)),
      vectors_(pool_bytes(context)),
      tangents_and_colors_(pool_bytes(context)),
      uvs_(pool_bytes(context)),
      mip_pyramid_(context),
      mipmapped_(images_with_mips(scene)),
      levels_(std::move(levels)),
      linear_from_srgb_(context, srgb_table()),
      albedo_table_(context, parity::albedo_table().values()) {
  if (!levels_.empty() && levels_.size() != scene.images.size())
    throw std::invalid_argument("gpu::SceneBuffers: levels of " + std::to_string(levels_.size()) +
                                " images, there are " + std::to_string(scene.images.size()));
  add_materials(context, scene);
  for (const SceneMesh& mesh : scene.meshes) {
    std::vector<PrimitiveSlices>& slices = primitives_.emplace_back();
    for (const parity::Primitive& primitive : mesh.primitives)
      slices.push_back(add_primitive(primitive));
  }
  indices_.upload(context);
  vectors_.upload(context);
  tangents_and_colors_.upload(context);
  uvs_.upload(context);
}

void SceneBuffers::add_materials(Context& context, const Scene& scene) {
  std::vector<SceneTexture> textures;
  std::vector<SceneMaterial> materials;
  for (const Material& material : scene.materials)
    add_material(context, scene, material, textures, materials);
  add_material(context, scene, Material{}, textures, materials);
  std::vector<SceneLayers> layers;
  for (const Material& material : scene.materials) layers.push_back(layers_of(material));
  layers.push_back(layers_of(Material{}));
  layers_ = Buffer<SceneLayers>(context, layers);
  materials_ = Buffer<SceneMaterial>(context, materials);
  textures_ = Buffer<SceneTexture>(context, textures);
}

void SceneBuffers::add_material(Context& context, const Scene& scene, const Material& material,
                                std::vector<SceneTexture>& textures,
                                std::vector<SceneMaterial>& materials) {
  SceneMaterial& entry = materials.emplace_back(without_textures(material));
  entry.first_texture = std::uint32_t(textures.size());
  std::vector<int>& sets = uv_sets_.emplace_back();
  const auto uses = textures_of(material);
  for (std::size_t role = 0; role < uses.size(); ++role) {
    const TextureUse& use = *uses[role];
    if (!is_there(scene, use)) continue;
    if (material.unlit && role != texture_base_color) continue;
    const std::uint32_t slot = slot_of(sets, use.uv_set);
    if (slot >= std::size(SceneDraw{}.uvs)) {
      sets.pop_back();
      continue;
    }
    const Texture& texture = scene.textures[std::size_t(use.texture)];
    const Texels& image = texels(context, scene, texture.image, is_srgb(TextureRole(role)));
    const mat3& m = use.texture_from_uv;
    textures.push_back({.texels = image.words,
                        .u_from_uv = vec3(m[0][0], m[1][0], m[2][0]),
                        .v_from_uv = vec3(m[0][1], m[1][1], m[2][1]),
                        .width = std::uint32_t(image.width),
                        .height = std::uint32_t(image.height),
                        .level_count = std::uint32_t(image.level_count),
                        .flags = std::uint32_t(role) | slot << texture_slot_shift |
                                 sampler_flags(texture.sampler) | image.flags});
  }
  features_.normal_maps |= needs_tangents(material) && !material.unlit;
  entry.texture_count = std::uint32_t(textures.size()) - entry.first_texture;
  features_.textures |= entry.texture_count > 0;
  features_.lit |= !material.unlit;
  features_.unlit |= material.unlit;
  features_.cuts_out |= material.alpha_mode == AlphaMode::mask;
  features_.uv_pairs = std::max(features_.uv_pairs, std::uint32_t((sets.size() + 1) / 2));
  alpha_modes_.push_back(is_blended(material) ? AlphaMode::blend : material.alpha_mode);
  double_sided_.push_back(material.double_sided);
  has_layers_.push_back(!material.unlit && is_layered(material));
  features_.layers |= has_layers_.back();
  is_metallic_.push_back(!material.unlit && material.metallic > 0);
  features_.metals |= is_metallic_.back();
}

const SceneBuffers::Texels& SceneBuffers::texels(Context& context, const Scene& scene, int image,
                                                 bool srgb) {
  const auto [place, is_new] = images_.try_emplace({image, srgb});
  if (!is_new) return place->second;
  const LevelRange range = levels_.empty() ? LevelRange{0, 99} : levels_[std::size_t(image)];
  // What is not seen at all is one texel.
  static const Grid<u8vec4> unseen{1, 1};
  const Grid<u8vec4>& grid = range.empty() ? unseen : scene.images[std::size_t(image)];
  const std::vector<MipLevel> levels = mip_levels(grid.width(), grid.height());
  const std::size_t count = mipmapped_[std::size_t(image)] ? levels.size() : 1;
  const auto clamped = [&](int level) {
    return std::clamp<std::size_t>(std::size_t(level), 0, count - 1);
  };
  const std::size_t first = range.empty() ? 0 : clamped(range.least);
  const std::size_t last = range.empty() ? 0 : clamped(range.greatest);
  std::vector<std::uint32_t> begins;
  for (std::size_t i = 0; i < count; ++i)
    begins.push_back(
        std::uint32_t(count + levels[std::clamp(i, first, last)].first - levels[first].first));
  Buffer<std::uint32_t> words = build_pyramid(context, mip_pyramid_, grid, srgb,
                                              {.head = count, .first = first, .last = last});
  words.write(begins);
  place->second = {std::move(words), grid.width(), grid.height(), int(count),
                   std::uint32_t(first) << texture_first_level_shift |
                       std::uint32_t(15 - last) << texture_last_level_shift};
  return place->second;
}

SceneBuffers::PrimitiveSlices SceneBuffers::add_primitive(const parity::Primitive& primitive) {
  PrimitiveSlices slices;
  slices.topology = primitive.topology;
  features_.unlit |= primitive.topology != Topology::triangles;
  slices.indices = indices_.add(primitive.indices);
  slices.positions = vectors_.add(primitive.positions);
  if (!primitive.normals.empty()) slices.normals = vectors_.add(primitive.normals);
  if (!primitive.tangents.empty() && features_.normal_maps)
    slices.tangents = tangents_and_colors_.add(primitive.tangents);
  if (!primitive.colors.empty()) slices.colors = tangents_and_colors_.add(primitive.colors);
  for (const std::vector<vec2>& uvs : primitive.uvs) {
    slices.uvs.emplace_back();
    if (!uvs.empty() && features_.textures) slices.uvs.back() = uvs_.add(uvs);
  }
  features_.colors |= slices.colors.has_value();
  return slices;
}

SceneDraw SceneBuffers::describe(const PrimitiveSlices& slices, int material) const {
  SceneDraw draw{};
  draw.material = number(material);
  draw.corners =
      slices.topology == Topology::triangles ? 3 : (slices.topology == Topology::lines ? 2 : 1);
  if (slices.topology != Topology::triangles) draw.flags |= draw_flag_unlit;
  draw.indices = indices_.ref(slices.indices);
  draw.positions = vectors_.ref(slices.positions);
  if (slices.normals) {
    draw.normals = vectors_.ref(*slices.normals);
    draw.flags |= draw_flag_normals;
  }
  if (slices.tangents) {
    draw.tangents = tangents_and_colors_.ref(*slices.tangents);
    draw.flags |= draw_flag_tangents;
  }
  if (slices.colors) {
    draw.colors = tangents_and_colors_.ref(*slices.colors);
    draw.flags |= draw_flag_colors;
  }
  const std::vector<int>& sets = uv_sets_[draw.material];
  for (std::size_t slot = 0; slot < sets.size(); ++slot) {
    const auto set = std::size_t(sets[slot]);
    if (set >= slices.uvs.size() || !slices.uvs[set]) continue;
    draw.uvs[slot] = uvs_.ref(*slices.uvs[set]);
    draw.flags |= draw_flag_uvs << slot;
  }
  return draw;
}

}  // namespace parity::gpu
