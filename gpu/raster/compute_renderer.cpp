#include "gpu/raster/compute_renderer.h"

#include <algorithm>

#include "gpu/raster/pipeline_renderer.h"
#include "shaders.h"

namespace parity::gpu {
namespace {

/// An element as triangles: lines and points are two.
void add_element(std::vector<uvec2>& items, std::uint32_t draw, std::uint32_t first,
                 std::uint32_t corners) {
  items.emplace_back(draw, first);
  if (corners != 3) items.emplace_back(draw, first | item_second_half);
}

TileRasterizerOptions rasterizer_options(const Frame& frame, std::uint32_t item_count) {
  return {.width = frame.options.width,
          .height = frame.options.height,
          .samples = frame.options.samples,
          .snapping = Snapping::mesa,
          .depth = frame.options.depth,
          .near = float(frame.near),
          .far = float(frame.far),
          .triangle_capacity = item_count};
}

std::vector<Specialization> shade_constants(const SceneBuffers& scene, RenderOptions options,
                                            const Frame& frame) {
  std::vector<Specialization> constants = scene_specializations(scene.features(), options);
  constants.push_back({10, std::uint32_t(frame.options.samples)});
  constants.push_back({11, std::uint32_t(frame.options.depth)});
  constants.push_back({22, scene.features().layers});
  constants.push_back({25, scene.features().metals});
  constants.push_back({23, frame.environment.has_value()});
  constants.push_back({24, !frame.shadows.empty()});
  constants.push_back({26, !frame.openness.empty()});
  constants.push_back({27, frame.behind.has_value()});
  return constants;
}

std::size_t pixel_count(const Frame& frame) {
  return std::size_t(frame.options.width) * std::size_t(frame.options.height);
}

template <typename T>
Grid<T> grid(const Frame& frame, const Buffer<T>& buffer) {
  Grid<T> result(frame.options.width, frame.options.height);
  result.values() = buffer.read();
  return result;
}

}  // namespace

std::vector<uvec2> triangle_items(const Frame& frame, const SceneBuffers& scene,
                                  const SceneFrame& data) {
  std::vector<uvec2> items;
  for (std::size_t i = 0; i < frame.draws.size(); ++i) {
    const Draw& draw = frame.draws[i];
    if (scene.alpha_mode(draw.material) == AlphaMode::blend) continue;
    const std::uint32_t corners = data.draws()[i].corners;
    const std::size_t count = scene.primitive(draw.mesh, draw.primitive).indices.count;
    for (std::size_t first = 0; first + corners <= count; first += corners)
      add_element(items, std::uint32_t(i), std::uint32_t(first), corners);
  }
  for (const uvec2& element : data.order())
    add_element(items, element.x, element.y, data.draws()[element.x].corners);
  return items;
}

ComputeRenderer::Target::Target(Context& context, const SceneBuffers& scene, RenderOptions options,
                                const Frame& frame, std::uint32_t item_count)
    : rasterizer(context, rasterizer_options(frame, item_count)),
      has_environment(frame.environment.has_value()),
      has_shadows(!frame.shadows.empty()),
      has_openness(!frame.openness.empty()),
      has_behind(frame.behind.has_value()),
      triangles_kernel(context, shaders::raster_scene_triangles_comp),
      shade_kernel(context, shaders::raster_scene_shade_comp,
                   shade_constants(scene, options, frame)),
      clip_positions(context, std::size_t(item_count) * 3),
      triangles(context, item_count),
      flags(context, item_count),
      color(context, pixel_count(frame)),
      depth(context, pixel_count(frame)),
      element(context, pixel_count(frame)) {}

bool ComputeRenderer::Target::fits(const Frame& frame, std::uint32_t item_count) const {
  const TileRasterizerOptions& have = rasterizer.options();
  const TileRasterizerOptions want = rasterizer_options(frame, item_count);
  return have.width == want.width && have.height == want.height && have.samples == want.samples &&
         have.depth == want.depth && have.near == want.near && have.far == want.far &&
         have.triangle_capacity == want.triangle_capacity &&
         has_environment == frame.environment.has_value() &&
         has_shadows == !frame.shadows.empty() && has_openness == !frame.openness.empty() &&
         has_behind == frame.behind.has_value();
}

void ComputeRenderer::record(Commands& commands, const Frame& frame, const Buffer<SceneArgs>& args,
                             const Buffer<uvec2>& items, bool has_unseen) {
  Target& t = *target_;
  const auto count = std::uint32_t(items.count());
  const auto width = std::uint32_t(frame.options.width);
  const auto height = std::uint32_t(frame.options.height);
  commands.pass("vertex");
  if (count > 0)
    commands.dispatch(t.triangles_kernel, {.x = count},
                      SceneTriangleArgs{.scene = args,
                                        .items = items,
                                        .clip_positions = t.clip_positions,
                                        .triangles = t.triangles,
                                        .flags = t.flags,
                                        .count = count,
                                        .width = width,
                                        .height = height,
                                        .padding = 0});
  commands.pass("raster");
  t.rasterizer.record(commands, {.clip_positions = t.clip_positions,
                                 .triangles = t.triangles,
                                 .flags = t.flags,
                                 .triangle_count = count,
                                 .first_element = 1});
  commands.pass("shade");
  const vec4& b = frame.options.background;
  commands.dispatch(t.shade_kernel, {.x = width, .y = height},
                    SceneShadeArgs{.scene = args,
                                   .items = items,
                                   .clip_positions = t.clip_positions,
                                   .elements = t.rasterizer.elements(),
                                   .depths = t.rasterizer.depths(),
                                   .begins = t.rasterizer.tile_begins(),
                                   .tile_triangles = t.rasterizer.tile_triangles(),
                                   .out_color = t.color,
                                   .out_depth = t.depth,
                                   .out_element = t.element,
                                   .background = vec4(b.x * b.w, b.y * b.w, b.z * b.w, b.w),
                                   .width = width,
                                   .height = height,
                                   .has_unseen = has_unseen ? 1u : 0u,
                                   .padding = 0});
}

Picture ComputeRenderer::render(const Frame& frame, const SceneFrame& data) {
  const std::vector<uvec2> list = triangle_items(frame, scene_, data);
  const auto count = std::uint32_t(list.size());
  const Buffer<uvec2> items(context_, list);
  const Buffer<SceneArgs> args(context_, std::vector<SceneArgs>{data.args()});
  if (!target_ || !target_->fits(frame, count)) {
    target_.reset();
    target_.emplace(context_, scene_, options_, frame, count);
  }
  const bool has_unseen = !data.order().empty() || scene_.features().cuts_out;
  Timing timing;
  do {
    timing =
        context_.run([&](Commands& commands) { record(commands, frame, args, items, has_unseen); });
  } while (!target_->rasterizer.fit(context_));
  Picture result;
  result.color = grid(frame, target_->color);
  result.depth = grid(frame, target_->depth);
  if (options_.elements) result.element = grid(frame, target_->element);
  result.pass_seconds = timing.passes;
  return result;
}

}  // namespace parity::gpu
