#include "gpu/numerics/conjugate_gradient.h"

#include <algorithm>

#include "shaders.h"

namespace parity::gpu {
namespace {

enum class VectorStep : std::uint32_t { dots, direction, advance, sums, subtract_mean };

constexpr std::uint32_t quads_a_thread = 16;

Kernel<VectorArgs> make_vectors(Context& context, const PressureSystem& system, VectorStep step) {
  return Kernel<VectorArgs>(context, shaders::numerics_vectors_comp,
                            {{1, std::uint32_t(step)}, {2, system.tiles() != nullptr ? 1u : 0u}});
}

}  // namespace

ConjugateGradient::ConjugateGradient(Context& context, PressureSystem& system,
                                     Preconditioner preconditioner)
    : system_(system),
      multigrid_(preconditioner == Preconditioner::multigrid
                     ? std::make_unique<Multigrid>(context, system)
                     : nullptr),
      residual_(system.make_sweep(context, Sweep::residual)),
      apply_(system.make_sweep(context, Sweep::apply)),
      dots_(make_vectors(context, system, VectorStep::dots)),
      direction_(make_vectors(context, system, VectorStep::direction)),
      advance_(make_vectors(context, system, VectorStep::advance)),
      sums_(make_vectors(context, system, VectorStep::sums)),
      subtract_mean_(make_vectors(context, system, VectorStep::subtract_mean)),
      solution_(context, system.quad_count()),
      solution_low_(context, system.quad_count()),
      direction_vector_(context, system.quad_count()),
      image_(context, system.quad_count()) {
  context.run([&](Commands& commands) {
    commands.fill(solution_, 0);
    commands.fill(direction_vector_, 0);
    commands.fill(image_, 0);
  });
}

std::uint32_t ConjugateGradient::vector_threads() const {
  return (system_.quad_count() + quads_a_thread - 1) / quads_a_thread;
}

void ConjugateGradient::record_vectors(Commands& commands, const Kernel<VectorArgs>& kernel) {
  // The residual lives in the right side, where the preconditioner takes it from; the
  // preconditioned residual in the pressure, where it leaves it.
  const VectorArgs args{.x = solution_,
                        .x_low = solution_low_,
                        .d = direction_vector_,
                        .r = system_.rhs(),
                        .q = image_,
                        .z = multigrid_ ? system_.pressure().ref() : system_.rhs().ref(),
                        .words = system_.finest().words,
                        .partials = system_.partials(),
                        .control = system_.control(),
                        .tiles = system_.tile_table(),
                        .cells = system_.finest().cells,
                        .row = system_.finest().row,
                        .quads = system_.quad_count(),
                        .run = quads_a_thread,
                        .mode = 0,
                        .padding = 0};
  if (system_.tiles() != nullptr) {
    system_.tiles()->dispatch(commands, kernel, tile_rows, args);
  } else {
    commands.dispatch(kernel, {vector_threads()}, args);
  }
}

void ConjugateGradient::record_solve(Commands& commands, std::uint32_t iterations,
                                     bool remove_mean) {
  if (remove_mean) {
    record_vectors(commands, sums_);
    system_.record_reduce(commands, Reduction::mean, vector_threads());
    record_vectors(commands, subtract_mean_);
  }
  commands.copy(system_.pressure(), solution_, 0, 0, system_.quad_count());
  commands.fill(solution_low_, 0);
  // Tiles that were left must not keep a direction.
  if (system_.tiles() != nullptr) commands.fill(direction_vector_, 0);
  system_.record_sweep(commands, residual_, system_.finest(), 0, 1, image_);
  commands.copy(image_, system_.rhs(), 0, 0, system_.quad_count());
  system_.record_reduce(commands, Reduction::largest_residual, system_.sweep_partials());
  record_more(commands, iterations);
}

void ConjugateGradient::record_more(Commands& commands, std::uint32_t iterations) {
  PressureLevel moving = system_.finest();
  moving.pressure = direction_vector_;
  for (std::uint32_t k = 0; k < iterations; ++k) {
    if (multigrid_) multigrid_->record_cycle(commands, true);
    record_vectors(commands, dots_);
    system_.record_reduce(commands, Reduction::next_direction, vector_threads());
    record_vectors(commands, direction_);
    system_.record_sweep(commands, apply_, moving, 0, 1, image_);
    system_.record_reduce(commands, Reduction::step_length, system_.sweep_partials());
    record_vectors(commands, advance_);
    system_.record_reduce(commands, Reduction::largest_residual, vector_threads());
  }
  commands.copy(solution_, system_.pressure(), 0, 0, system_.quad_count());
}

PressureAnswer conjugate_gradient(Context& context, const PressureProblem& problem,
                                  Preconditioner preconditioner) {
  PressureSystem system(context, shape_of(problem));
  ConjugateGradient solver(context, system, preconditioner);
  system.upload(context, problem);
  const int steps_a_run = preconditioner == Preconditioner::none ? 64 : 4;
  int steps = 0;
  do {
    const int more = std::min(steps_a_run, problem.max_iterations - steps);
    context.run([&](Commands& commands) {
      if (steps == 0) {
        solver.record_solve(commands, std::uint32_t(more));
      } else {
        solver.record_more(commands, std::uint32_t(more));
      }
    });
    steps += more;
  } while (steps < problem.max_iterations && system.read_control().done == 0);
  PressureAnswer answer = system.download();
  const Field low = system.to_field(solver.pressure_low().read());
  for (std::size_t i = 0; i < low.values.size(); ++i) answer.pressure.values[i] += low.values[i];
  return answer;
}

}  // namespace parity::gpu
