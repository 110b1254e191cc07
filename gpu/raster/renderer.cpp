#include "gpu/raster/renderer.h"

#include <algorithm>
#include <utility>

#include "gpu/raster/compute_renderer.h"
#include "gpu/raster/pipeline_renderer.h"
#include "gpu/raster/scene_buffers.h"
#include "gpu/raster/scene_frame.h"

namespace parity::gpu {
namespace {

Context& checked(Context& context) {
  if (can_render(context.info())) return context;
  throw Error(ErrorKind::missing_feature,
              "device " + context.info().name +
                  " cannot compile the renderer's shaders (structures that hold addresses)");
}

}  // namespace

bool can_render(const DeviceInfo& device) { return !device.is_swiftshader; }

struct Renderer::State {
  State(Context& device, const Scene& scene, RenderOptions render_options,
        std::vector<LevelRange> levels)
      : context(device),
        bytes_before(device.memory_bytes()),
        buffers(device, scene, std::move(levels)),
        blended(scene),
        pipelines(device, buffers, render_options),
        kernels(device, buffers, render_options) {}

  Context& context;
  std::uint64_t bytes_before;
  SceneBuffers buffers;
  BlendedPrimitives blended;
  PipelineRenderer pipelines;
  ComputeRenderer kernels;
};

Renderer::Renderer(Context& context, const Scene& scene, RenderOptions options,
                   std::vector<LevelRange> levels)
    : state_(std::make_unique<State>(checked(context), scene, options, std::move(levels))) {}
Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

Picture Renderer::render(const Frame& frame) {
  State& s = *state_;
  const FramePictures pictures(s.context, frame);
  const SceneFrame data(s.context, s.buffers, s.blended, frame, pictures);
  const std::vector<int>& counts = s.context.info().sample_counts;
  const bool offered =
      std::find(counts.begin(), counts.end(), frame.options.samples) != counts.end();
  Picture picture = offered ? s.pipelines.render(frame, data) : s.kernels.render(frame, data);
  picture.triangle_count = data.triangle_count();
  const std::uint64_t bytes = s.context.memory_bytes();
  picture.memory_bytes = bytes > s.bytes_before ? bytes - s.bytes_before : 0;
  return picture;
}

Picture render(Context& context, const Scene& scene, const Frame& frame, RenderOptions options) {
  std::vector<LevelRange> levels;
  if (!options.general) levels = read_levels(scene, frame);
  return Renderer(context, scene, options, std::move(levels)).render(frame);
}

}  // namespace parity::gpu
