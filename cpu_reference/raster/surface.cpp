#include "cpu_reference/raster/surface.h"

#include <cmath>
#include <set>

#include "cpu_reference/shading/shadow_map.h"
#include "cpu_reference/texture/mip_pyramid.h"

namespace parity::cpu {
namespace {

bool stores_srgb(std::size_t slot) { return is_srgb(TextureRole(slot)); }

/// The materials that the draws of a frame use; -1 for the default material is left out.
std::set<int> used_materials(const Frame& frame) {
  std::set<int> used;
  for (const Draw& draw : frame.draws)
    if (draw.material >= 0) used.insert(draw.material);
  return used;
}

struct PyramidJob {
  const Grid<u8vec4>* image = nullptr;
  bool srgb = false;
  bool all_levels = false;
  std::array<std::vector<Grid<u8vec4>>, std::size_t(MipRounding::count)>* levels = nullptr;
};

void build(std::vector<PyramidJob>& jobs, double mip_error) {
#pragma omp parallel for schedule(dynamic)
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    PyramidJob& job = jobs[i];
    const std::vector<Grid<dvec4>> means =
        job.all_levels ? mip_means(*job.image, job.srgb) : std::vector<Grid<dvec4>>{};
    const auto rounded = [&](double error) {
      return job.all_levels ? round_pyramid(means, error) : std::vector{*job.image};
    };
    (*job.levels)[std::size_t(MipRounding::nearest)] = rounded(0);
    if (mip_error == 0) continue;
    (*job.levels)[std::size_t(MipRounding::less)] = rounded(mip_error);
    (*job.levels)[std::size_t(MipRounding::more)] = rounded(-mip_error);
  }
}

std::array<dvec2, 3> transformed_uvs(const Primitive& p, const TextureUse& use,
                                     const std::array<std::uint32_t, 3>& vertices) {
  std::array<dvec2, 3> uv{};
  const std::size_t set = std::size_t(use.uv_set);
  if (set >= p.uvs.size() || p.uvs[set].empty()) return uv;
  const dmat3 texture_from_uv{use.texture_from_uv};
  for (std::size_t i = 0; i < 3; ++i)
    uv[i] = dvec2(texture_from_uv * dvec3(dvec2(p.uvs[set][vertices[i]]), 1.0));
  return uv;
}

std::array<double, shading_input::count> white_inputs() {
  std::array<double, shading_input::count> inputs{};
  for (std::size_t i = shading_input::color; i < shading_input::count; ++i) inputs[i] = 1;
  for (const std::size_t map : {shading_input::normal_texture, shading_input::coat_normal_texture})
    inputs[map] = inputs[map + 1] = 0.5;
  inputs[shading_input::anisotropy_texture + 1] = 0.5;
  return inputs;
}

void set_triple(std::array<double, shading_input::count>& inputs, std::size_t first,
                const dvec3& value) {
  for (int i = 0; i < 3; ++i) inputs[first + std::size_t(i)] = value[i];
}

}  // namespace

const TextureUse& texture_use(const Material& material, std::size_t slot) {
  return *textures_of(material)[slot];
}

SceneTextures::SceneTextures(const Scene& scene, const Frame& frame, double mip_error) {
  for (std::vector<MaterialTextures>& each : materials_) each.resize(scene.materials.size() + 1);
  const std::set<int> used = used_materials(frame);
  std::map<std::pair<int, bool>, PyramidJob> wanted;
  const auto visit = [&](auto&& action) {
    for (const int m : used)
      for (std::size_t slot = 0; slot < slot_count; ++slot) {
        const Material& material = scene.materials[std::size_t(m)];
        const int texture = texture_use(material, slot).texture;
        if (texture >= 0) action(m, slot, scene.textures[std::size_t(texture)]);
      }
  };
  visit([&](int, std::size_t slot, const Texture& texture) {
    const std::pair key{texture.image, stores_srgb(slot)};
    PyramidJob& job = wanted[key];
    job.image = &scene.images[std::size_t(texture.image)];
    job.srgb = key.second;
    job.all_levels |= texture.sampler.mip.has_value();
    job.levels = &pyramids_[key];
  });
  std::vector<PyramidJob> jobs;
  for (const auto& [key, job] : wanted) jobs.push_back(job);
  build(jobs, mip_error);
  visit([&](int m, std::size_t slot, const Texture& texture) {
    const Pyramids& roundings = pyramids_.at({texture.image, stores_srgb(slot)});
    for (std::size_t i = 0; i < roundings.size(); ++i)
      materials_[i][std::size_t(m) + 1][slot] = {roundings[mip_error == 0 ? 0 : i],
                                                 stores_srgb(slot), texture.sampler};
  });
}

std::uint64_t SceneTextures::memory_bytes() const {
  std::uint64_t bytes = 0;
  for (const auto& [key, roundings] : pyramids_)
    for (const Grid<u8vec4>& level : roundings[0]) bytes += level.size() * sizeof(u8vec4);
  return bytes;
}

ElementSurface element_surface(const PlacedDraw& placed, std::uint32_t element,
                               const SceneTextures& textures, const Frame& frame) {
  const Primitive& p = *placed.primitive;
  const Draw& draw = *placed.draw;
  const std::array<std::uint32_t, 3> vertices = element_vertices(placed, element);
  ElementSurface s;
  s.planes = element_planes(placed, element, frame.options.width, frame.options.height);
  s.material = placed.material;
  s.textures = &textures.of(draw.material);
  s.textures_less = &textures.of(draw.material, MipRounding::less);
  s.textures_more = &textures.of(draw.material, MipRounding::more);
  s.topology = p.topology;
  const dmat3 linear{draw.world_from_object};
  s.scale = std::cbrt(std::abs(glm::determinant(linear)));
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t v = vertices[i];
    s.position[i] = dvec3(draw.world_from_object * dvec4(dvec3(p.positions[v]), 1.0));
    if (!p.normals.empty()) s.normal[i] = draw.world_from_object_normal * dvec3(p.normals[v]);
    if (!p.tangents.empty()) {
      s.tangent[i] = linear * dvec3(p.tangents[v]);
      s.handedness[i] = double(p.tangents[v].w) * (draw.mirrored ? -1.0 : 1.0);
    }
    s.color[i] = p.colors.empty() ? dvec4(1.0) : dvec4(p.colors[v]);
  }
  for (std::size_t slot = 0; slot < slot_count; ++slot)
    if (!(*s.textures)[slot].levels.empty())
      s.uv[slot] = transformed_uvs(p, texture_use(*s.material, slot), vertices);
  return s;
}

QuadBarycentrics quad_barycentrics(const Planes& planes, int x, int y) {
  const int beside = x ^ 1, below = y ^ 1;
  return {barycentric(planes, x + 0.5, y + 0.5), barycentric(planes, beside + 0.5, y + 0.5),
          barycentric(planes, x + 0.5, below + 0.5), double(beside - x), double(below - y)};
}

TexturePlace texture_place(const ElementSurface& s, std::size_t slot, const QuadBarycentrics& b) {
  TexturePlace place;
  place.uv = interpolate(s.uv[slot], b.here);
  place.uv_dx = (interpolate(s.uv[slot], b.beside) - place.uv) * b.right;
  place.uv_dy = (interpolate(s.uv[slot], b.below) - place.uv) * b.down;
  const Grid<u8vec4>& image = (*s.textures)[slot].levels[0];
  place.lambda = level_of_detail(place.uv_dx, place.uv_dy, image.width(), image.height());
  return place;
}

void set_texture_inputs(std::array<double, shading_input::count>& inputs, std::size_t slot,
                        const dvec4& value) {
  namespace input = shading_input;
  const auto color = [&](std::size_t first) { set_triple(inputs, first, dvec3(value)); };
  switch (TextureRole(slot)) {
    case TextureRole::base_color:
      color(input::base_texture);
      inputs[input::base_texture + 3] = value.w;
      break;
    case TextureRole::metallic_roughness:
      inputs[input::roughness_texture] = value.y;
      inputs[input::metallic_texture] = value.z;
      break;
    case TextureRole::normal:
      return color(input::normal_texture);
    case TextureRole::occlusion:
      inputs[input::occlusion_texture] = value.x;
      break;
    case TextureRole::emission:
      return color(input::emission_texture);
    case TextureRole::specular:
      inputs[input::specular_texture] = value.w;
      break;
    case TextureRole::specular_color:
      return color(input::specular_color_texture);
    case TextureRole::clearcoat:
      inputs[input::clearcoat_texture] = value.x;
      break;
    case TextureRole::clearcoat_roughness:
      inputs[input::coat_roughness_texture] = value.y;
      break;
    case TextureRole::clearcoat_normal:
      return color(input::coat_normal_texture);
    case TextureRole::sheen_color:
      return color(input::sheen_color_texture);
    case TextureRole::sheen_roughness:
      inputs[input::sheen_roughness_texture] = value.w;
      break;
    case TextureRole::anisotropy:
      return color(input::anisotropy_texture);
    case TextureRole::iridescence:
      inputs[input::iridescence_texture] = value.x;
      break;
    case TextureRole::iridescence_thickness:
      inputs[input::film_thickness_texture] = value.y;
      break;
    case TextureRole::transmission:
      inputs[input::transmission_texture] = value.x;
      break;
    case TextureRole::thickness:
      inputs[input::thickness_texture] = value.y;
      break;
  }
}

ShadingPoint<double> shading_point(const ElementSurface& s, int x, int y, bool back) {
  static const std::array<double, shading_input::count> white = white_inputs();
  ShadingPoint<double> point;
  point.inputs = white;
  point.back = back;
  point.scale = s.scale;
  const QuadBarycentrics b = quad_barycentrics(s.planes, x, y);
  set_triple(point.inputs, shading_input::position, interpolate(s.position, b.here));
  set_triple(point.inputs, shading_input::normal, interpolate(s.normal, b.here));
  set_triple(point.inputs, shading_input::tangent, interpolate(s.tangent, b.here));
  point.inputs[shading_input::handedness] = interpolate(s.handedness, b.here);
  const dvec4 color = interpolate(s.color, b.here);
  set_triple(point.inputs, shading_input::color, dvec3(color));
  point.inputs[shading_input::color + 3] = color.w;
  for (std::size_t slot = 0; slot < slot_count; ++slot) {
    const MippedTexture& texture = (*s.textures)[slot];
    if (texture.levels.empty()) continue;
    const TexturePlace place = texture_place(s, slot, b);
    set_texture_inputs(point.inputs, slot, sample(texture, place.footprint()).value);
  }
  return point;
}

ShadowQuery shadow_query(const ShadingPoint<double>& point, const ShadingScene& scene) {
  const auto triple = [&](std::size_t first) {
    return dvec3(point.inputs[first], point.inputs[first + 1], point.inputs[first + 2]);
  };
  const dvec3 normal = triple(shading_input::normal);
  const double length = glm::length(normal);
  ShadowQuery query{.position = triple(shading_input::position), .origin = scene.eye};
  if (length > 0) query.normal = normal * ((point.back ? -1.0 : 1.0) / length);
  return query;
}

Shaded<double> shade_at(const ElementSurface& s, const ShadingScene& scene, int x, int y,
                        bool back) {
  if (s.topology == Topology::triangles) {
    ShadingPoint<double> point = shading_point(s, x, y, back);
    for (std::size_t i = 0; scene.shadows != nullptr && i < scene.shadows->size(); ++i)
      point.visible[i] = visibility((*scene.shadows)[i], shadow_query(point, scene)).value;
    point.openness = openness_at(scene, *s.material, x, y);
    return shade(*s.material, scene, point);
  }
  const dvec4 color =
      interpolate(s.color, barycentric(s.planes, x + 0.5, y + 0.5)) * dvec4(s.material->base_color);
  return {{color.x, color.y, color.z}, color.w};
}

double alpha_at(const ElementSurface& s, int x, int y) {
  const QuadBarycentrics b = quad_barycentrics(s.planes, x, y);
  double alpha = double(s.material->base_color.w) * interpolate(s.color, b.here).w;
  const MippedTexture& texture = (*s.textures)[slot_base_color];
  if (texture.levels.empty()) return alpha;
  const TexturePlace place = texture_place(s, slot_base_color, b);
  return alpha * sample(texture, place.footprint()).value.w;
}

}  // namespace parity::cpu
