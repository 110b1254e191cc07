#include "gpu/raster/pipeline_renderer.h"

#include <bit>
#include <limits>

#include "gpu/raster/half.h"
#include "shaders.h"

namespace parity::gpu {
namespace {

bool is_reversed(const Frame& frame) { return frame.options.depth == DepthMode::reverse_z; }

std::array<float, 4> clear_color(const Frame& frame) {
  const vec4& b = frame.options.background;
  return {b.x * b.w, b.y * b.w, b.z * b.w, b.w};
}

Primitive primitive_of(Topology topology) {
  switch (topology) {
    case Topology::points:
      return Primitive::points;
    case Topology::lines:
      return Primitive::lines;
    default:
      return Primitive::triangles;
  }
}

std::uint32_t corners_of(Topology topology) {
  return topology == Topology::triangles ? 3 : (topology == Topology::lines ? 2 : 1);
}

const ShaderCode& fragment_shader(bool element, bool logarithmic) {
  if (element)
    return logarithmic ? shaders::raster_scene_element_log_depth_frag
                       : shaders::raster_scene_element_frag;
  return logarithmic ? shaders::raster_scene_log_depth_frag : shaders::raster_scene_frag;
}

Format color_format(RenderOptions options) {
  return options.full_float ? Format::rgba32_float : Format::rgba16_float;
}

Image target(Context& context, const Frame& frame, Format format, int samples) {
  return Image(context, {.width = frame.options.width,
                         .height = frame.options.height,
                         .samples = samples,
                         .format = format});
}

std::size_t pixel_count(const Frame& frame) {
  return std::size_t(frame.options.width) * std::size_t(frame.options.height);
}

template <typename T>
Grid<T> grid(const Frame& frame, std::vector<T> values) {
  Grid<T> result(frame.options.width, frame.options.height);
  result.values() = std::move(values);
  return result;
}

/// Only how vertices are pulled, what the target holds and which buffers there are: the defaults of
/// the rest leave nothing out.
std::vector<Specialization> general_specializations(std::vector<Specialization> all) {
  std::erase_if(all, [](const Specialization& s) {
    return s.id < 4 || s.id == 7 || (s.id > 8 && s.id < 14) || s.id == 15 || s.id == 22 ||
           s.id == 24 || s.id == 25;
  });
  return all;
}

}  // namespace

std::vector<Specialization> scene_specializations(const SceneFeatures& features,
                                                  const RenderOptions& options) {
  const float largest = options.full_float ? std::numeric_limits<float>::max() : 65504.0f;
  return {{0, features.textures},
          {1, features.normal_maps},
          {2, features.lit},
          {3, features.uv_pairs},
          {4, std::bit_cast<std::uint32_t>(largest)},
          {7, features.colors},
          {13, features.unlit}};
}

PipelineRenderer::Targets::Targets(Context& context, const Frame& frame, RenderOptions options)
    : color(target(context, frame, color_format(options), frame.options.samples)),
      depth(target(context, frame, Format::d32_float, frame.options.samples)),
      color_words(context, pixel_count(frame) * (options.full_float ? 4 : 2)),
      depth_values(context, pixel_count(frame)) {
  const int samples = frame.options.samples;
  if (options.elements) {
    element.emplace(target(context, frame, Format::r32_uint, samples));
    element_values = Buffer<std::uint32_t>(context, pixel_count(frame));
  }
  if (samples == 1) return;
  resolved_color.emplace(target(context, frame, color_format(options), 1));
  resolved_depth.emplace(target(context, frame, Format::d32_float, 1));
  if (options.elements) resolved_element.emplace(target(context, frame, Format::r32_uint, 1));
}

bool PipelineRenderer::Targets::fits(const Frame& frame) const {
  const ImageOptions& o = color.options();
  return o.width == frame.options.width && o.height == frame.options.height &&
         o.samples == frame.options.samples;
}

PipelineRenderer::Key PipelineRenderer::key_of(const Frame& frame, const SceneFrame& data,
                                               const Draw& draw) const {
  const AlphaMode mode = scene_.alpha_mode(draw.material);
  const SceneFeatures& has = scene_.features();
  const bool is_plain = !has.textures && !has.colors && !has.normal_maps &&
                        mode != AlphaMode::blend && !options_.general && !options_.elements &&
                        frame.options.depth != DepthMode::logarithmic;
  return {scene_.primitive(draw.mesh, draw.primitive).topology,
          frame.options.depth,
          frame.options.samples,
          mode == AlphaMode::blend,
          mode == AlphaMode::mask,
          data.has_placed_lights(),
          is_plain,
          frame.environment.has_value(),
          scene_.has_layers(draw.material),
          scene_.is_metallic(draw.material),
          data.has_shadows(),
          !frame.openness.empty(),
          frame.behind.has_value()};
}

const RasterPipeline<SceneArgs>& PipelineRenderer::pipeline(const Key& key) {
  const auto found = pipelines_.find(key);
  if (found != pipelines_.end()) return found->second;
  const bool element = options_.elements && !key.blended;
  RasterOptions options;
  options.colors = {color_format(options_)};
  if (element) options.colors.push_back(Format::r32_uint);
  if (key.blended) options.blends = {Blend::source_over};
  options.depth = Format::d32_float;
  options.depth_compare = key.depth == DepthMode::reverse_z ? Compare::greater : Compare::less;
  options.depth_write = !key.blended;
  options.primitive = primitive_of(key.topology);
  options.samples = key.samples;
  options.specializations = scene_specializations(scene_.features(), options_);
  options.specializations.push_back({5, key.blended ? 2u : (element ? 1u : 0u)});
  options.specializations.push_back({6, corners_of(key.topology)});
  options.specializations.push_back({8, key.blended});
  options.specializations.push_back({9, key.cuts_out});
  options.specializations.push_back({12, key.blended});
  options.specializations.push_back({14, !key.blended});
  options.specializations.push_back({15, key.has_placed_lights});
  options.specializations.push_back({22, key.layers});
  options.specializations.push_back({25, key.metallic});
  options.specializations.push_back({23, key.environment});
  options.specializations.push_back({24, key.shadows});
  options.specializations.push_back({26, key.openness});
  options.specializations.push_back({27, key.behind});
  if (options_.general) options.specializations = general_specializations(options.specializations);
  const ShaderCode& vertex =
      key.is_plain ? shaders::raster_scene_plain_vert : shaders::raster_scene_vert;
  const ShaderCode& fragment = key.is_plain
                                   ? shaders::raster_scene_plain_frag
                                   : fragment_shader(element, key.depth == DepthMode::logarithmic);
  return pipelines_.try_emplace(key, context_, vertex, fragment, options).first->second;
}

void PipelineRenderer::prepare(const Frame& frame, const SceneFrame& data) {
  if (!targets_ || !targets_->fits(frame)) {
    targets_.reset();
    targets_.emplace(context_, frame, options_);
  }
  for (const Draw& draw : frame.draws) pipeline(key_of(frame, data, draw));
}

RenderTargets PipelineRenderer::opaque_targets(const Frame& frame, bool resolve) const {
  const Targets& t = *targets_;
  const auto resolved = [&](const std::optional<Image>& image) {
    return image ? &*image : nullptr;
  };
  RenderTargets targets;
  targets.colors.push_back({.image = &t.color,
                            .clear = clear_color(frame),
                            .resolve = resolve ? resolved(t.resolved_color) : nullptr});
  if (t.element)
    targets.colors.push_back({.image = &*t.element,
                              .clear = std::array<float, 4>{},
                              .resolve = resolved(t.resolved_element)});
  targets.depth = DepthTarget{.image = &t.depth,
                              .clear = is_reversed(frame) ? 0.0f : 1.0f,
                              .resolve = resolved(t.resolved_depth)};
  return targets;
}

RenderTargets PipelineRenderer::blend_targets() const {
  const Targets& t = *targets_;
  RenderTargets targets;
  targets.colors.push_back({.image = &t.color,
                            .clear = std::nullopt,
                            .resolve = t.resolved_color ? &*t.resolved_color : nullptr});
  targets.depth = DepthTarget{.image = &t.depth, .clear = std::nullopt, .resolve = nullptr};
  return targets;
}

/// In the order of the scene, so that of equal depths the first is kept.
void PipelineRenderer::draw_opaque(RenderPass& pass, const Frame& frame, const SceneFrame& data) {
  for (std::size_t i = 0; i < frame.draws.size(); ++i) {
    const Draw& draw = frame.draws[i];
    const Key key = key_of(frame, data, draw);
    const SceneBuffers::PrimitiveSlices& slices = scene_.primitive(draw.mesh, draw.primitive);
    if (key.blended || slices.indices.count == 0) continue;
    const Culling culling =
        scene_.double_sided(draw.material) || slices.topology != Topology::triangles
            ? Culling::none
            : (draw.mirrored ? Culling::front : Culling::back);
    pass.set_culling(culling, false);
    if (options_.elements) {
      pass.draw(pipeline(key), data.args_of(i), std::uint32_t(slices.indices.count));
      continue;
    }
    const IndexedDraw all{.index_count = std::uint32_t(slices.indices.count),
                          .first_index = std::uint32_t(slices.indices.first)};
    pass.draw_indexed(pipeline(key), data.args_of(i), scene_.index_buffer(slices), {&all, 1});
  }
}

/// Elements of one topology that follow each other in the sorted order share a draw.
void PipelineRenderer::draw_blended(RenderPass& pass, const Frame& frame, const SceneFrame& data) {
  const std::vector<uvec2>& order = data.order();
  std::size_t first = 0;
  while (first < order.size()) {
    const Draw& draw = frame.draws[order[first].x];
    const Key key = key_of(frame, data, draw);
    std::size_t end = first + 1;
    while (end < order.size() && key_of(frame, data, frame.draws[order[end].x]) == key) ++end;
    const std::uint32_t corners = corners_of(key.topology);
    pass.set_culling(Culling::none, false);
    pass.draw(pipeline(key), data.args(), std::uint32_t(end - first) * corners, 1,
              std::uint32_t(first) * corners, 0);
    first = end;
  }
}

void PipelineRenderer::draw(Commands& commands, const Frame& frame, const SceneFrame& data) {
  const bool blends = !data.order().empty();
  commands.pass("opaque");
  commands.render(opaque_targets(frame, !blends),
                  [&](RenderPass& pass) { draw_opaque(pass, frame, data); });
  if (!blends) return;
  commands.pass("blend");
  commands.render(blend_targets(), [&](RenderPass& pass) { draw_blended(pass, frame, data); });
}

void PipelineRenderer::record(Commands& commands, const Frame& frame, const SceneFrame& data) {
  draw(commands, frame, data);
  commands.copy(targets_->resolved_color ? *targets_->resolved_color : targets_->color,
                targets_->color_words);
}

void PipelineRenderer::read_back(Commands& commands) const {
  const Targets& t = *targets_;
  commands.copy(t.resolved_color ? *t.resolved_color : t.color, t.color_words);
  commands.copy(t.resolved_depth ? *t.resolved_depth : t.depth, t.depth_values);
  if (t.element)
    commands.copy(t.resolved_element ? *t.resolved_element : *t.element, t.element_values);
}

Picture PipelineRenderer::picture(const Frame& frame) const {
  const Targets& t = *targets_;
  Picture result;
  const std::vector<std::uint32_t> words = t.color_words.read();
  result.color =
      grid(frame, options_.full_float ? vec4_from_floats(words) : vec4_from_halves(words));
  result.depth = grid(frame, t.depth_values.read());
  if (t.element) result.element = grid(frame, t.element_values.read());
  return result;
}

Picture PipelineRenderer::render(const Frame& frame, const SceneFrame& data) {
  prepare(frame, data);
  const Timing timing = context_.run([&](Commands& commands) {
    draw(commands, frame, data);
    commands.pass("readback");
    read_back(commands);
  });
  Picture result = picture(frame);
  result.pass_seconds = timing.passes;
  return result;
}

}  // namespace parity::gpu
