#pragma once

#include <map>
#include <optional>
#include <span>
#include <vector>

#include "geometry/scene.h"
#include "geometry/texture_levels.h"
#include "gpu/core/buffer.h"
#include "gpu/raster/pool.h"
#include "gpu/texture/mip_pyramid.h"
#include "shaders/raster/scene_layout.h"

namespace parity::gpu {

/// What a scene makes the shaders do; all else is left out of them.
struct SceneFeatures {
  bool textures = false;
  bool normal_maps = false;  ///< or what else needs tangents
  bool layers = false;       ///< some material has extensions
  bool metals = false;       ///< some material is metallic
  bool lit = false;          ///< some material is not unlit
  bool unlit = false;        ///< some material is, or there are points or lines
  bool colors = false;
  bool cuts_out = false;
  std::uint32_t uv_pairs = 0;  ///< pairs of uv sets that one material reads
};

/// A scene on the device: geometry, materials and textures, for any number of frames.
class SceneBuffers {
 public:
  /// Where a primitive's arrays lie.
  struct PrimitiveSlices {
    Topology topology = Topology::triangles;
    Pool<std::uint32_t>::Slice indices;
    Pool<vec3>::Slice positions;
    std::optional<Pool<vec3>::Slice> normals;
    std::optional<Pool<vec4>::Slice> tangents;
    std::optional<Pool<vec4>::Slice> colors;
    std::vector<std::optional<Pool<vec2>::Slice>> uvs;  ///< by TEXCOORD_n
  };

  /// @param levels  of each image that will be read; none: all.
  /// @throws Error  out of memory, or an image or array is larger than a buffer may be.
  /// @throws std::invalid_argument  levels of another number of images.
  SceneBuffers(Context& context, const Scene& scene, std::vector<LevelRange> levels = {});

  const SceneFeatures& features() const { return features_; }
  const PrimitiveSlices& primitive(int mesh, int primitive) const {
    return primitives_[std::size_t(mesh)][std::size_t(primitive)];
  }
  /// Attributes, indices and the material's uv sets of a primitive; places and numbers are left 0.
  SceneDraw describe(const PrimitiveSlices& slices, int material) const;
  const Buffer<std::uint32_t>& index_buffer(const PrimitiveSlices& slices) const {
    return indices_.buffer(slices.indices);
  }
  /// As scene.materials; -1 names the default. `blend` for all that is drawn over what is behind.
  AlphaMode alpha_mode(int material) const { return alpha_modes_[number(material)]; }
  bool double_sided(int material) const { return double_sided_[number(material)]; }
  bool has_layers(int material) const { return has_layers_[number(material)]; }
  bool is_metallic(int material) const { return is_metallic_[number(material)]; }
  std::uint32_t number(int material) const {
    return material < 0 ? std::uint32_t(alpha_modes_.size() - 1) : std::uint32_t(material);
  }

  BufferRef<SceneMaterial> materials() const { return materials_; }
  BufferRef<SceneTexture> textures() const { return textures_; }
  BufferRef<SceneLayers> layers() const { return layers_; }
  BufferRef<vec4> albedo_table() const { return albedo_table_; }
  BufferRef<float> linear_from_srgb() const { return linear_from_srgb_; }

 private:
  /// An image as the shaders read it: where each level begins, then all texels.
  struct Texels {
    Buffer<std::uint32_t> words;
    int width = 0;
    int height = 0;
    int level_count = 0;
    std::uint32_t flags = 0;  ///< which levels are there
  };
  using ImageKey = std::pair<int, bool>;  ///< image, decoded from sRGB

  void add_materials(Context& context, const Scene& scene);
  void add_material(Context& context, const Scene& scene, const Material& material,
                    std::vector<SceneTexture>& textures, std::vector<SceneMaterial>& materials);
  PrimitiveSlices add_primitive(const parity::Primitive& primitive);
  const Texels& texels(Context& context, const Scene& scene, int image, bool srgb);

  SceneFeatures features_;
  Pool<std::uint32_t> indices_;
  Pool<vec3> vectors_;
  Pool<vec4> tangents_and_colors_;
  Pool<vec2> uvs_;
  std::vector<std::vector<PrimitiveSlices>> primitives_;
  MipPyramid mip_pyramid_;
  std::map<ImageKey, Texels> images_;
  std::vector<bool> mipmapped_;            ///< by image
  std::vector<LevelRange> levels_;         ///< by image; empty: all
  std::vector<std::vector<int>> uv_sets_;  ///< by material and slot
  std::vector<AlphaMode> alpha_modes_;     ///< by material, the default last
  std::vector<bool> double_sided_;
  std::vector<bool> has_layers_;
  std::vector<bool> is_metallic_;
  Buffer<SceneMaterial> materials_;
  Buffer<SceneTexture> textures_;
  Buffer<SceneLayers> layers_;
  Buffer<float> linear_from_srgb_;
  Buffer<vec4> albedo_table_;
};

}  // namespace parity::gpu
