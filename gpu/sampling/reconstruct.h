#pragma once

#include "geometry/grid.h"
#include "geometry/math.h"
#include "geometry/sampling.h"
#include "gpu/core/buffer.h"
#include "gpu/core/commands.h"
#include "gpu/core/kernel.h"
#include "shaders/sampling/layout.h"

namespace parity::gpu {

/// Resamples pictures of one size to another: along the rows, then along the columns.
///
/// Mathematics: cpu::reconstruct.
class Reconstruction {
 public:
  /// @throws std::invalid_argument  a side outside 1..16384, or a filter that spans more than
  ///                                50,000 texels.
  Reconstruction(Context& context, ivec2 from, ivec2 to, ReconstructionFilter filter);

  /// @param from, to  row-major, of the two sizes.
  void record(Commands& commands, const Buffer<vec4>& from, const Buffer<vec4>& to);

 private:
  uvec2 from_, to_;
  ReconstructionFilter filter_;
  Kernel<ReconstructArgs> kernel_;
  Buffer<vec4> rows_;  ///< as wide as the result, as high as the source
};

/// Uploads, resamples, reads back.
Grid<vec4> reconstruct(Context& context, const Grid<vec4>& picture, ivec2 size,
                       ReconstructionFilter filter);

}  // namespace parity::gpu
