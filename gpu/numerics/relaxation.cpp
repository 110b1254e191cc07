#include "gpu/numerics/relaxation.h"

#include <algorithm>
#include <utility>

namespace parity::gpu {

Relaxation::Relaxation(Context& context, PressureSystem& system, RelaxationMethod method)
    : system_(system),
      method_(method),
      sweep_(system.make_sweep(
          context, method == RelaxationMethod::jacobi ? Sweep::jacobi : Sweep::smooth_colour)),
      measure_(system.make_sweep(context, Sweep::measure)),
      other_(context, method == RelaxationMethod::jacobi ? system.quad_count() : 0) {
  if (method == RelaxationMethod::jacobi)
    context.run([&](Commands& commands) { commands.fill(other_, 0); });
}

void Relaxation::record_sweeps(Commands& commands, std::uint32_t count, float omega) {
  PressureLevel level = system_.finest();
  BufferRef<PressureQuad> other = other_;
  for (std::uint32_t k = 0; k < count; ++k) {
    if (method_ == RelaxationMethod::jacobi) {
      system_.record_sweep(commands, sweep_, level, 0, omega, other);
      std::swap(level.pressure, other);
    } else {
      system_.record_sweep(commands, sweep_, level, 0, omega);
      system_.record_sweep(commands, sweep_, level, 1, omega);
    }
  }
}

void Relaxation::record_measure(Commands& commands) {
  system_.record_sweep(commands, measure_, system_.finest(), 0, 1);
  system_.record_reduce(commands, Reduction::largest_residual, system_.sweep_partials());
}

PressureAnswer relaxation(Context& context, const PressureProblem& problem, RelaxationMethod method,
                          double omega) {
  PressureSystem system(context, shape_of(problem));
  Relaxation solver(context, system, method);
  system.upload(context, problem);
  constexpr int sweeps_a_look = 16, looks_a_run = 16;
  int sweeps = 0;
  PressureAnswer answer;
  do {
    int recorded = 0;
    context.run([&](Commands& commands) {
      for (int look = 0; look < looks_a_run && sweeps + recorded < problem.max_iterations; ++look) {
        solver.record_sweeps(commands, sweeps_a_look, float(omega));
        solver.record_measure(commands);
        recorded += sweeps_a_look;
      }
    });
    sweeps += recorded;
  } while (sweeps < problem.max_iterations && system.read_control().done == 0);
  answer = system.download();
  answer.iterations = sweeps;
  return answer;
}

}  // namespace parity::gpu
