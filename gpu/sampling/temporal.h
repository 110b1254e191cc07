#pragma once

#include "geometry/sampling.h"
#include "gpu/core/commands.h"
#include "gpu/core/kernel.h"
#include "shaders/sampling/layout.h"

namespace parity::gpu {

/// Adds a jittered frame to a history of frames.
///
/// Mathematics: cpu::accumulate. History and result must be different buffers: swap them from frame
/// to frame.
class TemporalAccumulation {
 public:
  explicit TemporalAccumulation(Context& context);
  void record(Commands& commands, const TemporalArgs& args);

 private:
  Kernel<TemporalArgs> kernel_;
};

/// Uploads, accumulates, reads back.
///
/// @throws std::invalid_argument  sizes differ or are 0; longest below 1.
Grid<vec4> accumulate(Context& context, const TemporalStep& step);

}  // namespace parity::gpu
