#include "gpu/raster/viewport.h"

#include <stdexcept>
#include <string>

#include "gpu/core/buffer.h"
#include "gpu/core/commands.h"
#include "gpu/core/kernel.h"
#include "shaders.h"
#include "shaders/raster/layout.h"

namespace parity::gpu {

std::vector<vec4> to_window(Context& context, std::span<const vec4> clip_positions, int width,
                            int height) {
  if (width < 1 || width > 16384 || height < 1 || height > 16384)
    throw std::invalid_argument("gpu::to_window: size is " + std::to_string(width) + "x" +
                                std::to_string(height) + ", sides must be 1 to 16384");
  if (clip_positions.empty()) return {};
  const Buffer<vec4> clip(context, clip_positions);
  const Buffer<vec4> window(context, clip.count());
  const Kernel<ViewportArgs> kernel(context, shaders::raster_viewport_comp);
  const auto count = std::uint32_t(clip.count());
  context.run([&](Commands& commands) {
    commands.dispatch(kernel, {count},
                      {clip, window, count, std::uint32_t(width), std::uint32_t(height), 0});
  });
  return window.read();
}

}  // namespace parity::gpu
