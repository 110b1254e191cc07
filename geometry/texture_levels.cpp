#include "geometry/texture_levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "geometry/mip_pyramid.h"
#include "geometry/texture_footprint.h"

namespace parity {
namespace {

/// Of texture coordinates, relative, as devices compute them.
constexpr double rounding = 2e-6;

/// Of one triangle, for a sampler.
LevelRange levels_of(const FootprintBounds& f, const Sampler& sampler, int last) {
  if (!sampler.mip) return {0, 0};
  const bool follows = sampler.max_anisotropy >= 2 && sampler.mag == Filter::linear &&
                       sampler.min == Filter::linear && sampler.mip == Filter::linear;
  double low =
      std::log2(std::max(std::sqrt((f.major * f.major + f.minor * f.minor) / 2), f.shortest));
  double high = std::log2(f.longest);
  if (follows && f.longest < 0.98) return {0, 0};  // magnified
  if (follows) {
    const double most = std::min(sampler.max_anisotropy, 16);
    // Where that leaves out the full size, the major axis is above sqrt(2): none of it is mixed in.
    low = std::log2(std::max(f.minor, f.major / most)) + 0.5;
    high = 0.5 * std::log2(std::max({f.area, f.longest * f.longest / (most * most), 1.0})) + 0.5;
  }
  LevelRange range{0, last};
  if (low - 0.05 > 0) range.least = int(std::min(low - 0.05, double(last)));
  if (high + 0.05 < last) range.greatest = int(std::max(std::floor(high + 0.05) + 1, 0.0));
  return range;
}

/// What a draw reads by one use of a texture.
class UseLevels {
 public:
  UseLevels(const Scene& scene, const ShadingView& view, const TextureUse& use)
      : view_(view), use_(use), texture_(scene.textures[std::size_t(use.texture)]) {
    const Grid<u8vec4>& image = scene.images[std::size_t(texture_.image)];
    size_ = {image.width(), image.height()};
    last_ = texture_.sampler.mip ? int(mip_levels(image.width(), image.height()).size()) - 1 : 0;
  }

  std::size_t image() const { return std::size_t(texture_.image); }
  const LevelRange& range() const { return range_; }
  bool is_full() const { return range_.least == 0 && range_.greatest >= last_; }

  /// What does not hang on the triangles; then it is full, or needs no more.
  bool settle(const Primitive& p, bool is_mask) {
    const std::size_t set = std::size_t(use_.uv_set);
    if (is_mask || p.topology != Topology::triangles)
      range_ = {0, last_};
    else if (set >= p.uvs.size() || p.uvs[set].empty())
      range_ = {0, 0};
    return !range_.empty();
  }

  void add(const ShadedPlaces& piece, const Primitive& p, const std::uint32_t* vertices) {
    if (!is_full()) range_.join(of_piece(piece, texels(p.uvs[std::size_t(use_.uv_set)], vertices)));
  }

 private:
  LevelRange of_piece(const ShadedPlaces& piece, const std::array<dvec2, 3>& uv) const {
    FootprintBounds f = footprint_bounds(view_, piece, uv);
    double reach = 0;
    for (const dvec2& t : uv) reach = std::max({reach, std::abs(t.x), std::abs(t.y)});
    f.major = std::max(f.major - rounding * reach, 0.0);
    f.minor = std::max(f.minor - rounding * reach, 0.0);
    f.shortest = std::max(f.shortest - rounding * reach, 0.0);
    f.longest += rounding * reach;
    return levels_of(f, texture_.sampler, last_);
  }

  std::array<dvec2, 3> texels(const std::vector<vec2>& from, const std::uint32_t* vertices) const {
    std::array<dvec2, 3> uv;
    for (std::size_t k = 0; k < 3; ++k)
      uv[k] = size_ * dvec2(dmat3(use_.texture_from_uv) * dvec3(dvec2(from[vertices[k]]), 1));
    return uv;
  }

  const ShadingView& view_;
  const TextureUse& use_;
  const Texture& texture_;
  dvec2 size_{1.0};
  int last_ = 0;
  LevelRange range_;
};

std::vector<UseLevels> uses_of(const Scene& scene, const ShadingView& view,
                               const Material& material) {
  std::vector<UseLevels> uses;
  for (const TextureUse* use : textures_of(material)) {
    if (use->texture < 0) continue;
    const int image = scene.textures[std::size_t(use->texture)].image;
    if (!scene.images[std::size_t(image)].empty()) uses.emplace_back(scene, view, *use);
  }
  return uses;
}

void add_triangles(const ShadingView& view, const Draw& draw, const Primitive& p, bool double_sided,
                   std::vector<UseLevels*> uses) {
  for (std::size_t i = 0; i + 2 < p.indices.size() && !uses.empty(); i += 3) {
    const ShadedPlaces piece = shaded_places(view, draw, double_sided, p.positions, &p.indices[i]);
    if (piece.places.empty()) continue;
    for (UseLevels* use : uses) use->add(piece, p, &p.indices[i]);
    std::erase_if(uses, [](const UseLevels* use) { return use->is_full(); });
  }
}

}  // namespace

void LevelRange::join(const LevelRange& other) {
  least = std::min(least, other.least);
  greatest = std::max(greatest, other.greatest);
}

void join(std::vector<LevelRange>& levels, const std::vector<LevelRange>& others) {
  for (std::size_t i = 0; i < levels.size(); ++i) levels[i].join(others[i]);
}

std::vector<LevelRange> read_levels(const Scene& scene, const Frame& frame, bool moves) {
  const ShadingView view(frame, moves);
  std::vector<LevelRange> levels(scene.images.size());
  for (const Draw& draw : frame.draws) {
    if (draw.material < 0) continue;
    const Material& material = scene.materials[std::size_t(draw.material)];
    const Primitive& primitive =
        scene.meshes[std::size_t(draw.mesh)].primitives[std::size_t(draw.primitive)];
    std::vector<UseLevels> uses = uses_of(scene, view, material);
    std::vector<UseLevels*> open;
    for (UseLevels& use : uses)
      if (!use.settle(primitive, material.alpha_mode == AlphaMode::mask)) open.push_back(&use);
    add_triangles(view, draw, primitive, material.double_sided, std::move(open));
    for (const UseLevels& use : uses) levels[use.image()].join(use.range());
  }
  return levels;
}

}  // namespace parity
