#include "gpu/sph/density.h"

#include "gpu/sph/constants.h"
#include "shaders.h"

namespace parity::gpu {

Densities::Densities(Context& context, const SphConstants& constants)
    : count_(constants.count),
      density_(context, shaders::sph_density_comp),
      places_(context, constants.count),
      motions_(context, constants.count) {}

void Densities::record(Commands& commands, const Neighbours& neighbours,
                       BufferRef<vec4> velocities) {
  if (count_ == 0) return;
  commands.dispatch(density_, {count_},
                    {.constants = neighbours.constants(),
                     .positions = neighbours.cells().sorted(),
                     .velocities = velocities,
                     .ids = neighbours.cells().ids(),
                     .densities = neighbours.densities(),
                     .places = places_,
                     .motions = motions_,
                     .count = count_});
}

std::vector<float> sph_densities(Context& context, const SphProblem& problem) {
  const SphConstants constants = sph_constants(problem);
  Neighbours neighbours(context, problem, constants);
  Densities densities(context, constants);
  const Buffer<vec4> positions(context, with_zero(problem.initial.positions));
  const Buffer<vec4> velocities(context, with_zero(problem.initial.velocities));
  context.run([&](Commands& commands) {
    neighbours.record(commands, positions);
    densities.record(commands, neighbours, velocities);
  });
  const std::vector<vec4> places = densities.places().read();
  const std::vector<std::uint32_t> ids = neighbours.cells().ids().read();
  std::vector<float> result(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) result[ids[i]] = places[i].w;
  return result;
}

}  // namespace parity::gpu
