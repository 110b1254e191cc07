#include "gpu/shading/tone_map.h"

#include <cmath>

#include "gpu/core/buffer.h"
#include "gpu/core/commands.h"
#include "gpu/core/kernel.h"
#include "shaders.h"
#include "shaders/shading/layout.h"

namespace parity::gpu {

Grid<vec4> tone_map(Context& context, const Grid<vec4>& colors, ToneMap tone_map, float exposure) {
  const Buffer<vec4> pixels(context, colors.values());
  const Kernel<ToneMapArgs> kernel(context, shaders::shading_tone_map_comp);
  const auto count = std::uint32_t(colors.size());
  context.run([&](Commands& commands) {
    commands.dispatch(
        kernel, {count},
        ToneMapArgs{pixels, count, std::uint32_t(tone_map), float(std::exp2(double(exposure))), 0});
  });
  Grid<vec4> mapped{colors.width(), colors.height()};
  mapped.values() = pixels.read();
  return mapped;
}

}  // namespace parity::gpu
