#pragma once

#include <map>
#include <optional>
#include <tuple>

#include "geometry/frame.h"
#include "gpu/core/commands.h"
#include "gpu/core/image.h"
#include "gpu/core/raster_pipeline.h"
#include "gpu/raster/renderer.h"
#include "gpu/raster/scene_buffers.h"
#include "gpu/raster/scene_frame.h"

namespace parity::gpu {

/// Specialization constants of raster/scene_shade.glsl and the vertex stage: what a scene needs.
std::vector<Specialization> scene_specializations(const SceneFeatures& features,
                                                  const RenderOptions& options);

/// Draws frames with the device's own rasteriser.
class PipelineRenderer {
 public:
  PipelineRenderer(Context& context, const SceneBuffers& scene, RenderOptions options)
      : context_(context), scene_(scene), options_(options) {}

  Picture render(const Frame& frame, const SceneFrame& data);

  /// For what makes one picture of several frames of one size: prepare() before the submission,
  /// record() in it.
  void prepare(const Frame& frame, const SceneFrame& data);
  /// Draws, and leaves the resolved colours in color_words().
  void record(Commands& commands, const Frame& frame, const SceneFrame& data);
  /// RGBA16F (RGBA32F: full_float), row-major.
  const Buffer<std::uint32_t>& color_words() const { return targets_->color_words; }

 private:
  /// What distinguishes pipelines.
  struct Key {
    Topology topology = Topology::triangles;
    DepthMode depth = DepthMode::reverse_z;
    int samples = 1;
    bool blended = false;
    bool cuts_out = false;
    bool has_placed_lights = false;
    bool is_plain = false;  ///< no attribute but positions and normals
    bool environment = false;
    bool layers = false;  ///< the material has extensions
    bool metallic = false;
    bool shadows = false;
    bool openness = false;
    bool behind = false;
    auto operator<=>(const Key&) const = default;
  };

  /// What is drawn to, and where it is read from.
  struct Targets {
    Targets(Context& context, const Frame& frame, RenderOptions options);
    bool fits(const Frame& frame) const;

    Image color;
    Image depth;
    std::optional<Image> element;
    std::optional<Image> resolved_color;
    std::optional<Image> resolved_depth;
    std::optional<Image> resolved_element;
    Buffer<std::uint32_t> color_words;
    Buffer<float> depth_values;
    Buffer<std::uint32_t> element_values;
  };

  const RasterPipeline<SceneArgs>& pipeline(const Key& key);
  RenderTargets opaque_targets(const Frame& frame, bool resolve) const;
  RenderTargets blend_targets() const;
  void draw_opaque(RenderPass& pass, const Frame& frame, const SceneFrame& data);
  void draw_blended(RenderPass& pass, const Frame& frame, const SceneFrame& data);
  void draw(Commands& commands, const Frame& frame, const SceneFrame& data);
  void read_back(Commands& commands) const;
  Picture picture(const Frame& frame) const;
  Key key_of(const Frame& frame, const SceneFrame& data, const Draw& draw) const;

  Context& context_;
  const SceneBuffers& scene_;
  RenderOptions options_;
  std::map<Key, RasterPipeline<SceneArgs>> pipelines_;
  std::optional<Targets> targets_;
};

}  // namespace parity::gpu
