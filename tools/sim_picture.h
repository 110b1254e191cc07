#pragma once

#include <memory>

#include "geometry/grid.h"
#include "gpu/core/context.h"
#include "sim/drawing.h"
#include "sim/scene.h"
#include "tools/sim_run.h"

namespace parity::tools {

/// What a frame of particles or smoke shows.
DrawnScene drawn_scene(const SimScene& scene, const SimContent& content);

/// What a frame of a flow in 2 dimensions shows.
DrawnField drawn_field(const SimScene& scene, const SimContent& content);

/// The view of a scene that leaves it to the program.
SimView view_of(const SimScene& scene);

/// Draws frames one after the other.
class FrameDrawer {
 public:
  /// @param context  null: the CPU reference.
  explicit FrameDrawer(gpu::Context* context);
  ~FrameDrawer();

  /// Linear RGB, alpha 1.
  Grid<vec4> draw(const SimScene& scene, const SimContent& content) const;

 private:
  struct Kernels;
  gpu::Context* context_;
  std::unique_ptr<Kernels> kernels_;
};

}  // namespace parity::tools
