#include "gpu/fluid/liquid.h"

#include <stdexcept>
#include <string>

#include "shaders.h"

namespace parity::gpu {

Liquid::Liquid(Context& context, FluidBuffers& buffers, const FluidProblem& problem)
    : buffers_(buffers),
      count_(std::uint32_t(problem.initial.particles.count())),
      key_bits_(problem.domain.cell_count() <= 65536 ? 16 : 32),
      positions_(context, count_),
      velocities_(context, count_),
      gradients_(context, count_),
      keys_(context, count_),
      sorted_(context, count_),
      ranges_(context, 2 * problem.domain.cell_count()),
      count_buffer_(context, std::vector<std::uint32_t>{count_}),
      sort_(context, count_),
      keys_kernel_(context, shaders::fluid_particle_keys_comp),
      ranges_kernel_(context, shaders::fluid_particle_ranges_comp),
      to_faces_(context, shaders::fluid_particles_to_faces_comp, {buffers.tiled()}),
      forces_(context, shaders::fluid_liquid_forces_comp, {buffers.tiled()}),
      to_particles_(context, shaders::fluid_faces_to_particles_comp) {}

void Liquid::write(const LiquidParticles& particles) {
  if (particles.count() != count_)
    throw std::invalid_argument("gpu::Liquid: there are " + std::to_string(particles.count()) +
                                " particles, must be " + std::to_string(count_));
  positions_.write(particles.positions);
  velocities_.write(particles.velocities);
  gradients_.write(particles.gradients);
}

LiquidParticles Liquid::read() const {
  return {positions_.read(), velocities_.read(), gradients_.read()};
}

LiquidArgs Liquid::args() const {
  return {.scene = buffers_.scene,
          .clock = buffers_.clock,
          .positions = positions_,
          .velocities = velocities_,
          .gradients = gradients_,
          .keys = keys_,
          .sorted = sorted_,
          .ranges = ranges_,
          .velocity = buffers_.velocity,
          .old = buffers_.other,
          .axis = 0,
          .count = count_};
}

void Liquid::record_sort(Commands& commands) {
  const LiquidArgs now = args();
  commands.fill(ranges_, 0);
  if (count_ > 0) {
    commands.dispatch(keys_kernel_, {count_}, now);
    sort_.record(commands, count_buffer_, keys_, sorted_, key_bits_);
    commands.dispatch(ranges_kernel_, {count_}, now);
  }
}

void Liquid::record_to_grid(Commands& commands) {
  LiquidArgs now = args();
  for (now.axis = 0; now.axis < (buffers_.cells.z > 1 ? 3u : 2u); ++now.axis)
    buffers_.dispatch(commands, to_faces_, now.axis, now);
}

void Liquid::record_forces(Commands& commands) {
  LiquidArgs now = args();
  for (now.axis = 0; now.axis < (buffers_.cells.z > 1 ? 3u : 2u); ++now.axis)
    buffers_.dispatch(commands, forces_, now.axis, now);
}

void Liquid::record_to_particles(Commands& commands) {
  if (count_ > 0) commands.dispatch(to_particles_, {count_}, args());
}

}  // namespace parity::gpu
