#include "gpu/raster/scene_frame.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "gpu/shading/punctual_light.h"

namespace parity::gpu {
namespace {

std::uint32_t corners_of(Topology topology) {
  return topology == Topology::triangles ? 3 : (topology == Topology::lines ? 2 : 1);
}

vec4 clip_position(const mat4& m, const vec3& p) {
  return ((m[0] * p.x + m[1] * p.y) + m[2] * p.z) + m[3];
}

/// Grows with the distance from the viewer.
float view_depth(const Frame& frame, const vec4& clip) {
  if (!frame.orthographic) return clip.w;
  return frame.options.depth == DepthMode::reverse_z ? -clip.z : clip.z;
}

vec3 centroid(const std::vector<vec3>& positions, const std::uint32_t* corners,
              std::uint32_t count) {
  const vec3& a = positions[corners[0]];
  if (count == 1) return a;
  const vec3& b = positions[corners[1]];
  if (count == 2) return (a + b) * 0.5f;
  return ((a + b) + positions[corners[2]]) * (1.0f / 3.0f);
}

/// Direction only: a factor keeps large and small scales within the range of float.
mat3 direction_matrix(const dmat3& m) {
  double largest = 0;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row) largest = std::max(largest, std::abs(m[column][row]));
  if (!(largest > 0) || !std::isfinite(largest)) return mat3(0.0f);
  return mat3(m * (1.0 / largest));
}

void place(SceneDraw& draw, const Draw& from, const dvec3& origin) {
  draw.clip_from_object = from.clip_from_object;
  draw.world_from_object = mat3(dmat3(from.world_from_object));
  draw.world_origin = vec3(dvec3(from.world_from_object[3]) - origin);
  draw.world_from_object_normal = direction_matrix(from.world_from_object_normal);
  draw.scale = float(std::cbrt(std::abs(glm::determinant(dmat3(from.world_from_object)))));
  if (from.mirrored) draw.flags |= draw_flag_mirrored;
}

std::vector<SceneLight> place_lights(const Frame& frame) {
  std::vector<SceneLight> lights;
  for (const PlacedLight& light : frame.lights) lights.push_back(scene_light(light, frame.eye));
  for (std::size_t i = 0; i < frame.shadows.size(); ++i)
    lights[std::size_t(frame.shadows[i].light)].shadow = std::uint32_t(i) + 1;
  return lights;
}

/// Positions stand relative to `origin`.
SceneShadow describe(const LightShadow& shadow, const dvec3& origin, BufferRef<float> depths) {
  SceneShadow result{};
  dmat4 world_from_position(1.0);
  world_from_position[3] = dvec4(origin, 1);
  // Nothing is nearer than the last end: what is beyond no cascade's.
  result.ends = vec4(-std::numeric_limits<float>::infinity());
  for (std::size_t k = 0; k < shadow.cascades.size(); ++k) {
    const ShadowCascade& cascade = shadow.cascades[k];
    result.shadow_from_position[k] = mat4(cascade.shadow_from_world * world_from_position);
    if (!shadow.is_cube) result.ends[int(k)] = float(cascade.end);
    result.lifts[k] = float(shadow.lift(k));
  }
  result.is_cube = shadow.is_cube ? 1u : 0u;
  result.center = vec3(shadow.center - origin);
  result.forward = vec3(shadow.forward);
  result.offset = float(glm::dot(shadow.forward, origin) + shadow.offset);
  result.depths = depths;
  result.side = std::uint32_t(shadow.cascades[0].depths.width());
  result.radius = std::uint32_t(shadow.radius);
  result.bias = shadow.bias;
  return result;
}

/// Positions stand relative to the eye.
SceneScreen describe_screen(const Frame& frame, BufferRef<float> openness, BufferRef<vec4> behind) {
  SceneScreen screen{};
  screen.size = {frame.options.width, frame.options.height};
  screen.openness = openness;
  screen.openness_size = {frame.openness.width(), frame.openness.height()};
  if (!frame.behind) return screen;
  const std::vector<Grid<vec4>>& levels = frame.behind->levels;
  if (levels.empty() || levels.size() > std::size(screen.behind_begins))
    throw std::invalid_argument("gpu::Renderer: what is behind has " +
                                std::to_string(levels.size()) + " levels, must be 1 to 16");
  screen.behind = behind;
  dmat4 world_from_position(1.0);
  world_from_position[3] = dvec4(frame.eye, 1);
  screen.clip_from_position = mat4(frame.behind->clip_from_world * world_from_position);
  screen.behind_size = {levels[0].width(), levels[0].height()};
  screen.behind_levels = std::uint32_t(levels.size());
  std::uint32_t begin = 0;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    screen.behind_begins[i] = begin;
    begin += std::uint32_t(levels[i].size());
  }
  return screen;
}

double log2_far_over_near(const Frame& frame) {
  if (frame.options.depth != DepthMode::logarithmic) return 1;
  if (!(frame.near > 0) || !(frame.far > frame.near))
    throw std::invalid_argument("gpu::Renderer: logarithmic depth from " +
                                std::to_string(frame.near) + " to " + std::to_string(frame.far) +
                                ", must be from above 0 to a finite far plane beyond");
  return std::log2(frame.far / frame.near);
}

}  // namespace

BlendedPrimitives::BlendedPrimitives(const Scene& scene) {
  for (std::size_t mesh = 0; mesh < scene.meshes.size(); ++mesh)
    for (std::size_t i = 0; i < scene.meshes[mesh].primitives.size(); ++i) {
      const parity::Primitive& primitive = scene.meshes[mesh].primitives[i];
      if (primitive.material < 0 || !is_blended(scene.materials[std::size_t(primitive.material)]))
        continue;
      elements_[{int(mesh), int(i)}] = {primitive.topology, primitive.positions, primitive.indices};
    }
}

std::vector<uvec2> BlendedPrimitives::order(Context& context, const Frame& frame) {
  std::vector<uvec2> elements;
  std::vector<float> depths;
  for (std::size_t draw = 0; draw < frame.draws.size(); ++draw) {
    const Draw& d = frame.draws[draw];
    const auto found = elements_.find({d.mesh, d.primitive});
    if (found == elements_.end()) continue;
    const std::uint32_t corners = corners_of(found->second.topology);
    const std::vector<std::uint32_t>& indices = found->second.indices;
    for (std::size_t first = 0; first + corners <= indices.size(); first += corners) {
      const vec3 middle = centroid(found->second.positions, &indices[first], corners);
      const float depth = view_depth(frame, clip_position(d.clip_from_object, middle));
      elements.emplace_back(std::uint32_t(draw), std::uint32_t(first));
      depths.push_back(std::isnan(depth) ? 0.0f : depth);  // what cannot be seen may stand anywhere
    }
  }
  if (elements.empty()) return {};
  if (!sorter_ || capacity_ < elements.size()) {
    sorter_.emplace(context, std::uint32_t(elements.size()));
    capacity_ = elements.size();
  }
  const Buffer<float> keys(context, depths);
  context.run(
      [&](Commands& commands) { sorter_->record(commands, keys, std::uint32_t(elements.size())); });
  std::vector<uvec2> sorted;
  sorted.reserve(elements.size());
  for (const std::uint32_t rank : sorter_->order().read(0, elements.size()))
    sorted.push_back(elements[rank]);
  return sorted;
}

SceneFrame::SceneFrame(Context& context, const SceneBuffers& scene, BlendedPrimitives& blended,
                       const Frame& frame, const FramePictures& pictures)
    : order_(blended.order(context, frame)) {
  std::uint32_t first_element = 0;
  for (const Draw& draw : frame.draws) {
    const SceneBuffers::PrimitiveSlices& slices = scene.primitive(draw.mesh, draw.primitive);
    SceneDraw& entry = draws_.emplace_back(scene.describe(slices, draw.material));
    place(entry, draw, frame.eye);
    entry.first_element = first_element;
    first_element += std::uint32_t(slices.indices.count / entry.corners);
    if (entry.corners == 3) triangle_count_ += slices.indices.count / 3;
  }
  draw_buffer_ = Buffer<SceneDraw>(context, draws_);
  light_buffer_ = Buffer<SceneLight>(context, place_lights(frame));
  order_buffer_ = Buffer<uvec2>(context, order_);
  std::vector<SceneShadow> shadows;
  for (std::size_t i = 0; i < frame.shadows.size(); ++i)
    shadows.push_back(describe(frame.shadows[i], frame.eye, pictures.shadow_depths(i)));
  if (!shadows.empty()) shadow_buffer_ = Buffer<SceneShadow>(context, shadows);
  if (!frame.openness.empty() || frame.behind)
    screen_ = Buffer<SceneScreen>(context, std::vector<SceneScreen>{describe_screen(
                                               frame, pictures.openness(), pictures.behind())});
  has_shadows_ = !shadows.empty();
  args_ = {.draws = draw_buffer_,
           .materials = scene.materials(),
           .textures = scene.textures(),
           .lights = light_buffer_,
           .linear_from_srgb = scene.linear_from_srgb(),
           .layers = scene.layers(),
           .environment = pictures.environment(),
           .albedo_table = scene.albedo_table(),
           .ambient = frame.ambient,
           .light_count = std::uint32_t(frame.lights.size()),
           .backward = vec3(frame.backward),
           .orthographic = frame.orthographic ? 1u : 0u,
           .near = float(frame.near),
           .log2_far_over_near = float(log2_far_over_near(frame)),
           .order = order_buffer_,
           .shadows = shadow_buffer_,
           .screen = screen_};
  has_placed_lights_ = std::ranges::any_of(frame.lights, [](const PlacedLight& placed) {
    return placed.light.kind != LightKind::directional;
  });
}

SceneArgs SceneFrame::args_of(std::size_t draw) const {
  SceneArgs args = args_;
  args.draws = draw_buffer_.ref(draw);
  const std::uint64_t material = draws_[draw].material;
  args.materials.address += material * sizeof(SceneMaterial);
  if (args.layers.address != 0) args.layers.address += material * sizeof(SceneLayers);
  return args;
}

}  // namespace parity::gpu
