#include "gpu/sph/forces.h"

#include "gpu/sph/constants.h"
#include "shaders.h"

namespace parity::gpu {

Forces::Forces(Context& context, const SphProblem& problem, const SphConstants& constants)
    : count_(constants.count),
      forces_(context, shaders::sph_forces_comp, {{0, std::uint32_t(problem.parameters.kernel)}}),
      accelerations_(context, constants.count) {}

void Forces::record(Commands& commands, const Neighbours& neighbours, const Densities& densities) {
  if (count_ == 0) return;
  commands.dispatch(forces_, {count_},
                    {.constants = neighbours.constants(),
                     .places = densities.places(),
                     .motions = densities.motions(),
                     .boundary = neighbours.boundary(),
                     .boundary_motions = neighbours.boundary_motions(),
                     .lists = neighbours.lists(),
                     .counts = neighbours.counts(),
                     .accelerations = accelerations_,
                     .count = count_});
}

std::vector<vec3> sph_accelerations(Context& context, const SphProblem& problem) {
  const SphConstants constants = sph_constants(problem);
  Neighbours neighbours(context, problem, constants);
  Densities densities(context, constants);
  Forces forces(context, problem, constants);
  const Buffer<vec4> positions(context, with_zero(problem.initial.positions));
  const Buffer<vec4> velocities(context, with_zero(problem.initial.velocities));
  context.run([&](Commands& commands) {
    neighbours.record(commands, positions);
    densities.record(commands, neighbours, velocities);
    forces.record(commands, neighbours, densities);
  });
  const std::vector<vec4> sorted = forces.accelerations().read();
  const std::vector<std::uint32_t> ids = neighbours.cells().ids().read();
  std::vector<vec3> result(sorted.size());
  for (std::size_t i = 0; i < sorted.size(); ++i) result[ids[i]] = vec3(sorted[i]);
  return result;
}

}  // namespace parity::gpu
