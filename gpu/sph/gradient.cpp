#include "gpu/sph/gradient.h"

#include "gpu/sph/constants.h"
#include "shaders.h"

namespace parity::gpu {

Gradients::Gradients(Context& context, const SphProblem& problem, const SphConstants& constants)
    : count_(constants.count),
      gradient_(context, shaders::sph_gradient_comp,
                {{0, std::uint32_t(problem.parameters.kernel)}}),
      gradients_(context, constants.count) {}

void Gradients::record(Commands& commands, const Neighbours& neighbours, const Densities& densities,
                       BufferRef<vec4> field) {
  if (count_ == 0) return;
  commands.dispatch(gradient_, {count_},
                    {.constants = neighbours.constants(),
                     .places = densities.places(),
                     .field = field,
                     .lists = neighbours.lists(),
                     .counts = neighbours.counts(),
                     .ids = neighbours.cells().ids(),
                     .gradients = gradients_,
                     .count = count_});
}

std::vector<mat3> sph_velocity_gradients(Context& context, const SphProblem& problem) {
  const SphConstants constants = sph_constants(problem);
  Neighbours neighbours(context, problem, constants);
  Densities densities(context, constants);
  Gradients gradients(context, problem, constants);
  const Buffer<vec4> positions(context, with_zero(problem.initial.positions));
  const Buffer<vec4> velocities(context, with_zero(problem.initial.velocities));
  context.run([&](Commands& commands) {
    neighbours.record(commands, positions);
    densities.record(commands, neighbours, velocities);
    gradients.record(commands, neighbours, densities, densities.motions());
  });
  return gradients.gradients().read();
}

}  // namespace parity::gpu
