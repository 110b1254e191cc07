#include "gpu/shading/shadow_map.h"

#include <stdexcept>
#include <string>

#include "gpu/core/buffer.h"
#include "gpu/core/commands.h"
#include "gpu/core/kernel.h"
#include "shaders.h"
#include "shaders/shading/layout.h"

namespace parity::gpu {

std::vector<float> shadow_map(Context& context, const ShadowProblem& p) {
  const int side = p.depths[0].width();
  std::vector<float> texels;
  for (const Grid<float>& map : p.depths) {
    if (map.width() != side || map.height() != side)
      throw std::invalid_argument("gpu::shadow_map: a map has " + std::to_string(map.width()) +
                                  "x" + std::to_string(map.height()) +
                                  " texels, all must be squares of one size");
    texels.insert(texels.end(), map.begin(), map.end());
  }
  if (p.radius < 0 || p.radius > 8)
    throw std::invalid_argument("gpu::shadow_map: radius is " + std::to_string(p.radius) +
                                ", must be 0 to 8");
  const Buffer<vec4> points(context, p.points);
  const Buffer<mat4> matrices(context, std::span<const mat4>(p.shadow_from_world));
  const Buffer<float> depths(context, texels), visibilities(context, p.points.size());
  const Kernel<ShadowArgs> kernel(context, shaders::shading_shadow_map_comp);
  const auto count = std::uint32_t(p.points.size());
  context.run([&](Commands& commands) {
    commands.dispatch(kernel, {count},
                      ShadowArgs{points, matrices, depths, visibilities, p.ends, count,
                                 std::uint32_t(side), std::uint32_t(p.radius), p.bias});
  });
  return visibilities.read();
}

}  // namespace parity::gpu
