#include "gpu/shading/brdf.h"

#include <stdexcept>

#include "gpu/core/buffer.h"
#include "gpu/core/commands.h"
#include "gpu/core/kernel.h"
#include "shaders.h"

namespace parity::gpu {

std::vector<vec3> brdf(Context& context, std::span<const BrdfQuery> queries,
                       const Grid<vec4>& albedo) {
  if (albedo.width() != int(albedo_side) || albedo.height() != int(albedo_side))
    throw std::invalid_argument("gpu::brdf: the albedo table has " +
                                std::to_string(albedo.width()) + "x" +
                                std::to_string(albedo.height()) + " entries, must have 16x16");
  const Buffer<BrdfQuery> in(context, queries);
  const Buffer<vec4> table(context, albedo.values());
  const Buffer<vec3> out(context, queries.size());
  const Kernel<BrdfArgs> kernel(context, shaders::shading_brdf_comp);
  const auto count = std::uint32_t(queries.size());
  context.run([&](Commands& commands) {
    commands.dispatch(kernel, {count}, BrdfArgs{in, table, out, count, 0});
  });
  return out.read();
}

}  // namespace parity::gpu
