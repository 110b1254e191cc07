#pragma once

#include <optional>
#include <vector>

#include "geometry/frame.h"
#include "gpu/core/commands.h"
#include "gpu/raster/renderer.h"
#include "gpu/raster/scene_buffers.h"
#include "gpu/raster/scene_frame.h"
#include "gpu/raster/tile_rasterizer.h"
#include "shaders/raster/scene_compute_layout.h"

namespace parity::gpu {

/// All elements of a frame as triangles (draw, first index; lines and points are two): the opaque
/// and masked in the order of the scene, then the blended from far to near.
std::vector<uvec2> triangle_items(const Frame& frame, const SceneBuffers& scene,
                                  const SceneFrame& data);

/// Draws frames in compute kernels, for sample counts that the device's own rasteriser lacks:
/// clip positions, TileRasterizer, then shading of what is seen, with the functions that the
/// fragment shaders run.
class ComputeRenderer {
 public:
  ComputeRenderer(Context& context, const SceneBuffers& scene, RenderOptions options)
      : context_(context), scene_(scene), options_(options) {}

  Picture render(const Frame& frame, const SceneFrame& data);

 private:
  /// Of one size, sample count and depth.
  struct Target {
    Target(Context& context, const SceneBuffers& scene, RenderOptions options, const Frame& frame,
           std::uint32_t item_count);
    bool fits(const Frame& frame, std::uint32_t item_count) const;

    TileRasterizer rasterizer;
    bool has_environment;
    bool has_shadows;
    bool has_openness;
    bool has_behind;
    Kernel<SceneTriangleArgs> triangles_kernel;
    Kernel<SceneShadeArgs> shade_kernel;
    Buffer<vec4> clip_positions;
    Buffer<uvec3> triangles;
    Buffer<std::uint32_t> flags;
    Buffer<vec4> color;
    Buffer<float> depth;
    Buffer<std::uint32_t> element;
  };

  void record(Commands& commands, const Frame& frame, const Buffer<SceneArgs>& args,
              const Buffer<uvec2>& items, bool has_unseen);

  Context& context_;
  const SceneBuffers& scene_;
  RenderOptions options_;
  std::optional<Target> target_;
};

}  // namespace parity::gpu
