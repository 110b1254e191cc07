#include "gpu/sph/pressure.h"

#include "gpu/sph/constants.h"
#include "shaders.h"

namespace parity::gpu {
namespace {

constexpr std::uint32_t block = 256;

std::vector<Specialization> kernel_of(const SphProblem& problem) {
  return {{0, std::uint32_t(problem.parameters.kernel)}};
}

}  // namespace

PressureSolver::PressureSolver(Context& context, const SphProblem& problem,
                               const SphConstants& constants)
    : count_(constants.count),
      max_iterations_(problem.parameters.max_iterations),
      tolerance_(float(problem.parameters.density_error)),
      is_divergence_free_(problem.parameters.method == SphMethod::divergence_free),
      begin_(context, shaders::sph_solve_begin_comp, kernel_of(problem)),
      predict_(context, shaders::sph_solve_predict_comp),
      move_(context, shaders::sph_solve_move_comp, kernel_of(problem)),
      press_(context, shaders::sph_solve_press_comp, kernel_of(problem)),
      check_(context, shaders::sph_solve_check_comp),
      stop_(context, shaders::sph_solve_stop_comp),
      impulses_(context, constants.count),
      predicted_(context, constants.count),
      moved_(context, constants.count),
      sums_(context, (constants.count + block - 1) / block),
      groups_(context, 9),
      solver_(context, std::vector<SphSolver>(1)),
      divergence_solver_(context, std::vector<SphSolver>(1)) {}

void PressureSolver::record(Commands& commands, const Neighbours& neighbours,
                            const Densities& densities, const Forces& forces,
                            BufferRef<SphClock> clock, BufferRef<float> pressures) {
  if (count_ == 0) return;
  SolveArgs args{.constants = neighbours.constants(),
                 .clock = clock,
                 .places = densities.places(),
                 .boundary = neighbours.boundary(),
                 .lists = neighbours.lists(),
                 .counts = neighbours.counts(),
                 .predicted = predicted_,
                 .impulses = impulses_,
                 .moved = moved_,
                 .solver = is_divergence_free_ ? divergence_solver_ : solver_,
                 .count = count_,
                 .divergence = is_divergence_free_ ? 1u : 0u};
  commands.dispatch(begin_, {count_},
                    {.constants = neighbours.constants(),
                     .clock = clock,
                     .ids = neighbours.cells().ids(),
                     .places = densities.places(),
                     .motions = densities.motions(),
                     .accelerations = forces.accelerations(),
                     .boundary = neighbours.boundary(),
                     .lists = neighbours.lists(),
                     .counts = neighbours.counts(),
                     .pressures = pressures,
                     .impulses = impulses_,
                     .predicted = predicted_,
                     .solver = args.solver,
                     .groups = groups_,
                     .count = count_,
                     .block = block,
                     .divergence = args.divergence});
  record_rounds(commands, args);
  if (!is_divergence_free_) return;
  commands.dispatch(predict_, {count_},
                    {.clock = clock,
                     .ids = neighbours.cells().ids(),
                     .places = densities.places(),
                     .accelerations = forces.accelerations(),
                     .moved = moved_,
                     .pressures = pressures,
                     .impulses = impulses_,
                     .predicted = predicted_,
                     .solver = solver_,
                     .groups = groups_,
                     .count = count_,
                     .block = block});
  args.solver = solver_;
  args.divergence = 0;
  record_rounds(commands, args);
}

void PressureSolver::record_rounds(Commands& commands, const SolveArgs& args) {
  const SolveCheckArgs check{.moved = moved_,
                             .sums = sums_,
                             .solver = args.solver,
                             .groups = groups_,
                             .count = count_,
                             .block = block,
                             .tolerance = tolerance_,
                             .least = args.divergence != 0 ? 1u : 2u};
  for (std::uint32_t k = 0; k < max_iterations_; ++k) {
    commands.dispatch_indirect(move_, groups_, 0, args);
    commands.dispatch_indirect(press_, groups_, 0, args);
    commands.dispatch_indirect(check_, groups_, 3, check);
    commands.dispatch_indirect(stop_, groups_, 6, check);
  }
}

std::vector<vec3> sph_incompressible_velocities(Context& context, const SphProblem& problem) {
  const SphConstants constants = sph_constants(problem);
  Neighbours neighbours(context, problem, constants);
  Densities densities(context, constants);
  Forces forces(context, problem, constants);
  PressureSolver solver(context, problem, constants);
  const Buffer<vec4> positions(context, with_zero(problem.initial.positions));
  const Buffer<vec4> velocities(context, with_zero(problem.initial.velocities));
  SphClock clock{};
  clock.step = constants.fixed_step;
  const Buffer<SphClock> clock_buffer(context, std::vector<SphClock>{clock});
  const Buffer<float> pressures(context, std::vector<float>(constants.count));
  context.run([&](Commands& commands) {
    neighbours.record(commands, positions);
    densities.record(commands, neighbours, velocities);
    forces.record(commands, neighbours, densities);
    solver.record(commands, neighbours, densities, forces, clock_buffer, pressures);
  });
  const std::vector<vec4> moved = solver.moved().read();
  const std::vector<std::uint32_t> ids = neighbours.cells().ids().read();
  std::vector<vec3> result(moved.size());
  for (std::size_t i = 0; i < moved.size(); ++i) result[ids[i]] = vec3(moved[i]);
  return result;
}

}  // namespace parity::gpu
