#pragma once

#include <memory>

#include "geometry/frame.h"
#include "geometry/scene.h"
#include "geometry/texture_levels.h"
#include "gpu/core/context.h"

namespace parity::gpu {

struct RenderOptions {
  bool elements = false;    ///< Picture::element too
  bool general = false;     ///< leaves nothing out of the shaders; the same picture bit by bit
  bool full_float = false;  ///< RGBA32F instead of RGBA16F; RGBA16F ends at 65504
};

/// Whether the renderer's shaders compile on a device: SwiftShader's compiler crashes on structures
/// that hold addresses and are read as a whole.
bool can_render(const DeviceInfo& device);

/// Draws a scene: uploaded once, then frame after frame. Sample counts that the device has are
/// drawn by its fixed-function pipeline, the others by compute kernels.
///
/// Mathematics: cpu::render. Precision: float; positions relative to the eye.
/// Points are 1 pixel wide, lines too; both show their base colour.
///
/// Source: notes 1, 2, 6.2, 6.3; glTF 2.0, section 3.9 and appendix B.
class Renderer {
 public:
  /// @param levels  what the frames to come read of each image (read_levels); none: all. Frames
  /// that
  ///                read more show what is nearest to it.
  /// @throws Error  the scene does not fit the device, or it cannot render.
  Renderer(Context& context, const Scene& scene, RenderOptions options = {},
           std::vector<LevelRange> levels = {});
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  /// @param frame  of the scene that was uploaded.
  /// @return       pass_seconds: `opaque`, `blend` (or `vertex`, `raster`, `shade` of the compute
  ///               kernels), `readback`.
  /// @throws std::invalid_argument  logarithmic depth without a far plane.
  /// @throws Error                  out of memory, device lost, timed out.
  Picture render(const Frame& frame);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// One frame of a scene: of its textures only what that reads is made, unless all is asked for
/// (RenderOptions::general).
Picture render(Context& context, const Scene& scene, const Frame& frame,
               RenderOptions options = {});

}  // namespace parity::gpu
