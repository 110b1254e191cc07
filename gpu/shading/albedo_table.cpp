#include "gpu/shading/albedo_table.h"

#include <stdexcept>
#include <string>

#include "gpu/core/buffer.h"
#include "gpu/core/commands.h"
#include "gpu/core/kernel.h"
#include "shaders.h"
#include "shaders/shading/layout.h"

namespace parity::gpu {

Grid<vec4> albedo_table(Context& context, int samples) {
  if (samples < 1 || samples > 128)
    throw std::invalid_argument("gpu::albedo_table: samples is " + std::to_string(samples) +
                                ", must be 1 to 128");
  Grid<vec4> table{int(albedo_side), int(albedo_side)};
  const Buffer<vec4> entries(context, table.size());
  const Kernel<AlbedoTableArgs> albedo(context, shaders::shading_albedo_table_comp);
  const Kernel<AlbedoTableArgs> mean(context, shaders::shading_albedo_mean_comp);
  const AlbedoTableArgs args{entries, std::uint32_t(samples), 0};
  context.run([&](Commands& commands) {
    commands.dispatch(albedo, {albedo_side * albedo_side}, args);
    commands.dispatch(mean, {albedo_side}, args);
  });
  table.values() = entries.read();
  return table;
}

}  // namespace parity::gpu
