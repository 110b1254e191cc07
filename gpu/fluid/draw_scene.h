#pragma once

#include "gpu/core/buffer.h"
#include "gpu/core/commands.h"
#include "gpu/core/kernel.h"
#include "shaders/fluid/draw_layout.h"
#include "sim/drawing.h"

namespace parity::gpu {

/// Draws pictures of simulations; keeps its kernels from picture to picture.
class SceneDrawer {
 public:
  explicit SceneDrawer(Context& context);

  /// Mathematics: cpu::draw_scene. Particles fall on the samples by the smallest distance, in any
  /// order with the same result.
  ///
  /// @return linear RGB, alpha 1.
  /// @throws std::invalid_argument  as check_drawn_scene.
  Grid<vec4> draw(Context& context, const DrawnScene& scene) const;

 private:
  Kernel<DrawSceneArgs> depth_, nearest_;
  Kernel<DrawLightArgs> light_;
  Kernel<DrawPictureArgs> picture_;
};

/// The same for one picture.
Grid<vec4> draw_scene(Context& context, const DrawnScene& scene);

}  // namespace parity::gpu
