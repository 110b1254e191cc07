#pragma once

#include <cstdint>

#include "geometry/raster.h"
#include "gpu/core/buffer.h"
#include "shaders/raster/layout.h"

namespace parity::gpu {

/// A triangle list on the device, its indices checked.
class TriangleBuffers {
 public:
  /// @throws std::invalid_argument  an index is out of range, a side is not 1 to 16384, samples is
  ///                                not 1, 2, 4 or 8; `who` begins the message.
  TriangleBuffers(Context& context, const TriangleList& list, const char* who);

  /// Elements are 1 + triangle.
  TriangleSource source() const;
  std::uint32_t triangle_count() const;

 private:
  Buffer<vec4> clip_positions_;
  Buffer<uvec3> triangles_;
  Buffer<std::uint32_t> flags_;
};

}  // namespace parity::gpu
