#include "gpu/shading/ambient_occlusion.h"

#include <stdexcept>
#include <string>

#include "gpu/core/buffer.h"
#include "gpu/core/commands.h"
#include "gpu/core/kernel.h"
#include "shaders.h"
#include "shaders/shading/layout.h"

namespace parity::gpu {

Grid<float> ambient_occlusion(Context& context, const OcclusionProblem& p) {
  if (!(p.radius > 0) || !(p.slope.x > 0) || !(p.slope.y > 0))
    throw std::invalid_argument("gpu::ambient_occlusion: radius is " + std::to_string(p.radius) +
                                ", slope " + std::to_string(p.slope.x) + ", " +
                                std::to_string(p.slope.y) + ", must be above 0");
  if (p.distances.empty()) return p.distances;
  const Buffer<float> distances(context, p.distances.values()), parts(context, p.parts);
  const Buffer<vec4> directions(context, p.slices);
  const Buffer<float> openness(context, p.distances.size());
  const Kernel<OcclusionArgs> kernel(context, shaders::shading_ambient_occlusion_comp);
  const auto width = std::uint32_t(p.distances.width());
  const auto height = std::uint32_t(p.distances.height());
  context.run([&](Commands& commands) {
    commands.dispatch(kernel, {.x = width, .y = height},
                      OcclusionArgs{distances, directions, parts, openness, p.slope, width, height,
                                    p.orthographic ? 1u : 0u, p.radius,
                                    std::uint32_t(p.slices.size()), std::uint32_t(p.parts.size())});
  });
  Grid<float> result(p.distances.width(), p.distances.height());
  result.values() = openness.read();
  return result;
}

}  // namespace parity::gpu
