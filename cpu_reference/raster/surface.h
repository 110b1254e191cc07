#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "cpu_reference/raster/elements.h"
#include "cpu_reference/raster/planes.h"
#include "cpu_reference/shading/metallic_roughness.h"
#include "cpu_reference/shading/shadow_map.h"
#include "cpu_reference/texture/anisotropic.h"

namespace parity::cpu {

/// The textures of a material, by TextureRole. No levels: none.
constexpr std::size_t slot_count = texture_role_count;
constexpr std::size_t slot_base_color = std::size_t(TextureRole::base_color);
using MaterialTextures = std::array<MippedTexture, slot_count>;

/// How a material uses the texture in a slot.
const TextureUse& texture_use(const Material& material, std::size_t slot);

/// How texels of mip levels are rounded: to the next code, or as a right device might whose value
/// before that is a little less or more.
enum class MipRounding : std::size_t { nearest, less, more, count };

/// Mip pyramids of all textures that a frame's draws use. Only level 0 where nothing reads more.
class SceneTextures {
 public:
  /// @param mip_error  of a device's mip levels before they are rounded, in codes; 0: all roundings
  ///                   are one.
  SceneTextures(const Scene& scene, const Frame& frame, double mip_error);
  SceneTextures(const SceneTextures&) = delete;
  SceneTextures& operator=(const SceneTextures&) = delete;

  /// @param material  index into Scene::materials, -1: the default material.
  const MaterialTextures& of(int material, MipRounding rounding = MipRounding::nearest) const {
    return materials_[std::size_t(rounding)][std::size_t(material + 1)];
  }
  std::uint64_t memory_bytes() const;

 private:
  using Pyramids = std::array<std::vector<Grid<u8vec4>>, std::size_t(MipRounding::count)>;
  std::map<std::pair<int, bool>, Pyramids> pyramids_;  ///< by image and sRGB
  std::array<std::vector<MaterialTextures>, std::size_t(MipRounding::count)> materials_;
};

/// An element with all that varies over it, in world space.
struct ElementSurface {
  Planes planes;
  const Material* material = nullptr;
  const MaterialTextures* textures = nullptr;
  const MaterialTextures* textures_less = nullptr;  ///< MipRounding
  const MaterialTextures* textures_more = nullptr;
  Topology topology = Topology::triangles;
  std::array<dvec3, 3> position{};
  std::array<dvec3, 3> normal{};  ///< any length
  std::array<dvec3, 3> tangent{};
  std::array<dvec4, 3> color{};
  std::array<std::array<dvec2, 3>, slot_count> uv{};  ///< transformed, by slot
  std::array<double, 3> handedness{1.0, 1.0, 1.0};
  double scale = 1;  ///< of the object: cube root of the volume of its unit cube
};
ElementSurface element_surface(const PlacedDraw& draw, std::uint32_t element,
                               const SceneTextures& textures, const Frame& frame);

/// Barycentric coordinates at the centre of a pixel and of the two pixels that it shares its 2x2
/// quad with, in its row and in its column.
struct QuadBarycentrics {
  dvec3 here{0.0};
  dvec3 beside{0.0};
  dvec3 below{0.0};  ///< or above, whichever is in the quad
  double right = 1;  ///< +1: `beside` is to the right, -1: to the left
  double down = 1;   ///< +1: `below` is below, -1: above
};
QuadBarycentrics quad_barycentrics(const Planes& planes, int x, int y);

template <class T>
T interpolate(const std::array<T, 3>& values, const dvec3& barycentric) {
  return values[0] * barycentric.x + values[1] * barycentric.y + values[2] * barycentric.z;
}

/// Transformed texture coordinates of a slot at a pixel and the level of detail there.
struct TexturePlace {
  dvec2 uv{0.0};
  dvec2 uv_dx{0.0};
  dvec2 uv_dy{0.0};
  double lambda = 0;
  Footprint footprint() const { return {uv, uv_dx, uv_dy}; }
};
TexturePlace texture_place(const ElementSurface& s, std::size_t slot, const QuadBarycentrics& b);

/// Varyings and textures at the centre of a pixel.
ShadingPoint<double> shading_point(const ElementSurface& s, int x, int y, bool back);

/// What shadow maps are asked there, without errors.
ShadowQuery shadow_query(const ShadingPoint<double>& point, const ShadingScene& scene);

/// What a surface gives at a pixel: shade for triangles, base colour times vertex colour for lines
/// and points.
Shaded<double> shade_at(const ElementSurface& s, const ShadingScene& scene, int x, int y,
                        bool back);

/// Alpha of the base colour alone, for the alpha test.
double alpha_at(const ElementSurface& s, int x, int y);

/// Stores what a texture gives in the inputs of its slot.
void set_texture_inputs(std::array<double, shading_input::count>& inputs, std::size_t slot,
                        const dvec4& value);

}  // namespace parity::cpu
