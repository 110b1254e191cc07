#pragma once

#include <cstdint>

#include "geometry/grid.h"
#include "geometry/math.h"
#include "gpu/core/buffer.h"
#include "gpu/core/commands.h"
#include "gpu/core/kernel.h"
#include "shaders/raster/layout.h"

namespace parity::gpu {

/// Encodes linear colours as sRGB bytes, for renderers.
class SrgbEncoder {
 public:
  explicit SrgbEncoder(Context& context);

  /// @param colors    `count` linear RGB and alpha.
  /// @param codes     `count` pixels: red in the lowest byte, alpha in the highest.
  /// @param exposure  stops: colours are multiplied by 2^exposure.
  void record(Commands& commands, BufferRef<vec4> colors, BufferRef<std::uint32_t> codes,
              std::uint32_t count, float exposure) const;

 private:
  Kernel<EncodeArgs> kernel_;
  Buffer<float> thresholds_;
};

/// The nearest sRGB bytes of linear colours times 2^exposure, clamped to 0..1 (NaN is 0); alpha is
/// linear and not exposed.
///
/// Mathematics: IEC 61966-2-1. Exact: a colour is compared with the values at which the code
/// changes, rounded up from double; no pow decides.
Grid<u8vec4> encode_srgb(Context& context, const Grid<vec4>& colors, float exposure);

}  // namespace parity::gpu
