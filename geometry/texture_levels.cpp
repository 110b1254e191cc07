#include "geometry/texture_levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/mip_pyramid.h"

namespace parity {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Bounds of what a pixel covers of a texture, in lengths of it.
struct Footprint {
  double shortest = 0;   ///< both differences to the next pixels are at least that long
  double narrowest = 0;  ///< so is the minor half axis; 0: not known
  double longest = infinity;
  double area = infinity;  ///< at most, of the parallelogram
};

/// A triangle in the window and in the world.
struct Corners {
  std::array<dvec2, 3> window;  ///< px
  std::array<double, 3> w;
  std::array<dvec3, 3> world;
};

enum class Seen { no, yes, unsure };

/// Nothing that is outside of one of the sides by a pixel is seen; what reaches the eye is unsure.
Seen place(const Draw& draw, const FrameOptions& o, const std::vector<vec3>& positions,
           const std::uint32_t* vertices, Corners& corners) {
  std::array<dvec4, 3> clip;
  for (std::size_t i = 0; i < 3; ++i) {
    const dvec3 p{positions[vertices[i]]};
    clip[i] = dmat4(draw.clip_from_object) * dvec4(p, 1);
    corners.world[i] = dvec3(draw.world_from_object * dvec4(p, 1));
  }
  const dvec2 rim{1 + 4.0 / o.width, 1 + 4.0 / o.height};
  const auto all = [&](auto&& test) { return std::ranges::all_of(clip, test); };
  for (int axis = 0; axis < 2; ++axis)
    if (all([&](const dvec4& c) { return c[axis] > rim[axis] * c.w; }) ||
        all([&](const dvec4& c) { return -c[axis] > rim[axis] * c.w; }))
      return Seen::no;
  if (all([](const dvec4& c) { return c.w <= 0; })) return Seen::no;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(clip[i].w > 0)) return Seen::unsure;
    corners.w[i] = clip[i].w;
    corners.window[i] = dvec2((clip[i].x / clip[i].w + 1) * o.width / 2,
                              (clip[i].y / clip[i].w + 1) * o.height / 2);
  }
  return Seen::yes;
}

double cross(const dvec2& a, const dvec2& b) { return a.x * b.y - a.y * b.x; }

/// Singular values of the map with columns a, b, the greater first.
dvec2 singular_values(const dvec2& a, const dvec2& b) {
  const double sum = glm::dot(a, a) + glm::dot(b, b), determinant = std::abs(cross(a, b));
  const double root = std::sqrt(std::max(sum * sum - 4 * determinant * determinant, 0.0));
  const double greater = std::sqrt((sum + root) / 2);
  return {greater, greater > 0 ? determinant / greater : 0.0};
}

/// Shortest change of texture coordinates over a metre of the triangle.
double least_density(const Corners& c, const std::array<dvec2, 3>& uv) {
  const dvec3 e1 = c.world[1] - c.world[0], e2 = c.world[2] - c.world[0];
  const double length = glm::length(e1);
  if (!(length > 0)) return 0;
  const dvec3 along = e1 / length;
  const double x = glm::dot(e2, along), y = glm::length(e2 - x * along);
  if (!(y > 1e-9 * length)) return 0;
  const dvec2 u = (uv[1] - uv[0]) / length;
  const dvec2 v = (uv[2] - uv[0] - x * u) / y;
  return singular_values(u, v).y;
}

/// Gradient over the window of a value that is affine in it.
dvec2 gradient(const Corners& c, double twice_area, const std::array<double, 3>& values) {
  const dvec2 e1 = c.window[1] - c.window[0], e2 = c.window[2] - c.window[0];
  const double d1 = values[1] - values[0], d2 = values[2] - values[0];
  return dvec2(d1 * e2.y - d2 * e1.y, d2 * e1.x - d1 * e2.x) / twice_area;
}

Footprint footprint(const Corners& c, const std::array<dvec2, 3>& uv, double metres_at_one,
                    bool orthographic) {
  Footprint f;
  const double nearest = std::min({c.w[0], c.w[1], c.w[2]});
  const double farthest = std::max({c.w[0], c.w[1], c.w[2]});
  f.shortest = 0.99 * least_density(c, uv) * metres_at_one * (orthographic ? 1 : nearest);
  const double twice_area = cross(c.window[1] - c.window[0], c.window[2] - c.window[0]);
  if (!(std::abs(twice_area) > 1e-3)) return f;
  const std::array<double, 3> inverse{1 / c.w[0], 1 / c.w[1], 1 / c.w[2]};
  const dvec2 d = gradient(c, twice_area, inverse);
  // Of several samples a pixel the shaded place may be outside, where the plane is nearer.
  f.shortest /= 1 + (std::abs(d.x) + std::abs(d.y)) * nearest;
  // Change of 1 / w over two pixels, of its least.
  const double change = 2 * (std::abs(d.x) + std::abs(d.y)) * farthest;
  if (!(change < 0.5)) return f;
  f.narrowest = f.shortest * (1 - change);
  const std::array<double, 3> u{uv[0].x / c.w[0], uv[1].x / c.w[1], uv[2].x / c.w[2]};
  const std::array<double, 3> v{uv[0].y / c.w[0], uv[1].y / c.w[1], uv[2].y / c.w[2]};
  const dvec2 u_gradient = gradient(c, twice_area, u), v_gradient = gradient(c, twice_area, v);
  double largest = 0, area = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const dvec2 across{u_gradient.x - uv[i].x * d.x, v_gradient.x - uv[i].y * d.x};
    const dvec2 down{u_gradient.y - uv[i].x * d.y, v_gradient.y - uv[i].y * d.y};
    largest = std::max(largest, singular_values(across, down).x);
    area = std::max(area, std::abs(cross(across, down)));
  }
  const double scale = farthest / (1 - change);
  f.longest = 1.01 * largest * scale;
  f.area = 1.01 * area * scale * scale;
  return f;
}

/// Of one triangle, for a sampler; `size` in texels.
LevelRange levels_of(const Footprint& f, const Sampler& sampler, const dvec2& size, int last) {
  if (!sampler.mip) return {0, 0};
  const double small = std::min(size.x, size.y), large = std::max(size.x, size.y);
  const double shortest = f.shortest * small, longest = f.longest * large;
  const bool follows = sampler.max_anisotropy >= 2 && sampler.mag == Filter::linear &&
                       sampler.min == Filter::linear && sampler.mip == Filter::linear;
  double low = std::log2(shortest), high = std::log2(longest);
  if (follows && longest < 0.98) return {0, 0};  // magnified
  if (follows) {
    const double most = std::min(sampler.max_anisotropy, 16);
    low = std::log2(std::max(f.narrowest * small, shortest / most)) + 0.5;
    high = 0.5 * std::log2(
                     std::max({f.area * size.x * size.y, longest * longest / (most * most), 1.0})) +
           0.5;
    // Near the full size both it and what is averaged are read.
    if (!(shortest > 1.5)) low = 0;
  }
  LevelRange range{0, last};
  if (low - 0.05 > 0) range.least = std::min(int(low - 0.05), last);
  if (high + 0.05 < last) range.greatest = std::max(int(std::floor(high + 0.05)) + 1, 0);
  return range;
}

/// Of a primitive in one place for one use of a texture.
class UseLevels {
 public:
  UseLevels(const Scene& scene, const Frame& frame, const TextureUse& use)
      : frame_(frame), use_(use), texture_(scene.textures[std::size_t(use.texture)]) {
    const Grid<u8vec4>& image = scene.images[std::size_t(texture_.image)];
    size_ = {image.width(), image.height()};
    last_ = int(mip_levels(image.width(), image.height()).size()) - 1;
    const dmat4& m = frame.clip_from_view;
    const double x = 1 / std::abs(m[0][0]), y = 1 / std::abs(m[1][1]);
    metres_ = 2 * std::min(x / frame.options.width, y / frame.options.height);
    if (!frame.orthographic) metres_ /= std::sqrt(1 + x * x + y * y);
  }

  LevelRange all() const { return {0, texture_.sampler.mip ? last_ : 0}; }

  LevelRange of(const Draw& draw, const Primitive& p) const {
    LevelRange range;
    if (p.topology != Topology::triangles) return range;
    const std::size_t set = std::size_t(use_.uv_set);
    const bool has_uvs = set < p.uvs.size() && !p.uvs[set].empty();
    for (std::size_t i = 0; i + 2 < p.indices.size(); i += 3) {
      Corners corners;
      const Seen seen = place(draw, frame_.options, p.positions, &p.indices[i], corners);
      if (seen == Seen::no) continue;
      if (seen == Seen::unsure || !has_uvs) return all();
      range.join(levels_of(
          footprint(corners, uvs(p.uvs[set], &p.indices[i]), metres_, frame_.orthographic),
          texture_.sampler, size_, last_));
      if (range.least == 0 && range.greatest >= all().greatest) return range;
    }
    return range;
  }

 private:
  std::array<dvec2, 3> uvs(const std::vector<vec2>& from, const std::uint32_t* vertices) const {
    std::array<dvec2, 3> uv;
    for (std::size_t k = 0; k < 3; ++k)
      uv[k] = dvec2(dmat3(use_.texture_from_uv) * dvec3(dvec2(from[vertices[k]]), 1));
    return uv;
  }

  const Frame& frame_;
  const TextureUse& use_;
  const Texture& texture_;
  dvec2 size_{1.0};
  int last_ = 0;
  double metres_ = 0;  ///< between rays a pixel apart, at distance 1, at least
};

}  // namespace

void LevelRange::join(const LevelRange& other) {
  least = std::min(least, other.least);
  greatest = std::max(greatest, other.greatest);
}

std::vector<LevelRange> read_levels(const Scene& scene, const Frame& frame) {
  std::vector<LevelRange> levels(scene.images.size());
  for (const Draw& draw : frame.draws) {
    if (draw.material < 0) continue;
    const Material& material = scene.materials[std::size_t(draw.material)];
    const Primitive& primitive =
        scene.meshes[std::size_t(draw.mesh)].primitives[std::size_t(draw.primitive)];
    for (const TextureUse* use : textures_of(material)) {
      if (use->texture < 0) continue;
      const int image = scene.textures[std::size_t(use->texture)].image;
      if (scene.images[std::size_t(image)].empty()) continue;
      const UseLevels of_use(scene, frame, *use);
      const bool is_mask = material.alpha_mode == AlphaMode::mask;
      levels[std::size_t(image)].join(is_mask ? of_use.all() : of_use.of(draw, primitive));
    }
  }
  return levels;
}

}  // namespace parity
