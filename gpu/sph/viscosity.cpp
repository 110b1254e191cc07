#include "gpu/sph/viscosity.h"

#include "gpu/sph/constants.h"
#include "shaders.h"

namespace parity::gpu {
namespace {

constexpr std::uint32_t block = 256;

}  // namespace

ViscositySolver::ViscositySolver(Context& context, const SphProblem& problem,
                                 const SphConstants& constants)
    : count_(constants.count),
      max_iterations_(problem.parameters.max_iterations),
      tolerance_(float(problem.parameters.viscosity_error)),
      begin_(context, shaders::sph_viscous_begin_comp),
      apply_(context, shaders::sph_viscous_apply_comp,
             {{0, std::uint32_t(problem.parameters.kernel)}}),
      sum_(context, shaders::sph_viscous_sum_comp),
      choose_(context, shaders::sph_viscous_choose_comp),
      update_(context, shaders::sph_viscous_update_comp),
      end_(context, shaders::sph_viscous_end_comp),
      solution_(context, count_),
      residual_(context, count_),
      product_(context, count_),
      direction_(context, count_),
      image_(context, count_),
      sums_(context, (count_ + block - 1) / block),
      groups_(context, 9),
      solver_(context, std::vector<SphViscous>(1)) {}

void ViscositySolver::record(Commands& commands, const Neighbours& neighbours,
                             const Densities& densities, BufferRef<vec4> accelerations,
                             BufferRef<SphClock> clock) {
  if (count_ == 0) return;
  commands.dispatch(begin_, {count_},
                    {.clock = clock,
                     .motions = densities.motions(),
                     .accelerations = accelerations,
                     .solution = solution_,
                     .direction = direction_,
                     .image = image_,
                     .solver = solver_,
                     .groups = groups_,
                     .count = count_,
                     .block = block});
  const ViscousApplyArgs apply{.constants = neighbours.constants(),
                               .clock = clock,
                               .places = densities.places(),
                               .boundary = neighbours.boundary(),
                               .boundary_motions = neighbours.boundary_motions(),
                               .lists = neighbours.lists(),
                               .counts = neighbours.counts(),
                               .from = solution_,
                               .to = residual_,
                               .solver = solver_,
                               .count = count_,
                               .first = 1};
  commands.dispatch(apply_, {count_}, apply);
  record_iterations(commands, apply);
  commands.dispatch(end_, {count_},
                    {.clock = clock,
                     .motions = densities.motions(),
                     .solution = solution_,
                     .accelerations = accelerations,
                     .count = count_});
}

void ViscositySolver::record_iterations(Commands& commands, ViscousApplyArgs apply) {
  const ViscousSumArgs sum{.residual = residual_,
                           .product = product_,
                           .solution = solution_,
                           .sums = sums_,
                           .solver = solver_,
                           .groups = groups_,
                           .count = count_,
                           .block = block,
                           .tolerance = tolerance_};
  const ViscousUpdateArgs update{.residual = residual_,
                                 .product = product_,
                                 .solution = solution_,
                                 .direction = direction_,
                                 .image = image_,
                                 .solver = solver_,
                                 .count = count_};
  apply.from = residual_;
  apply.to = product_;
  apply.first = 0;
  for (std::uint32_t k = 0; k < max_iterations_; ++k) {
    commands.dispatch_indirect(apply_, groups_, 0, apply);
    commands.dispatch_indirect(sum_, groups_, 3, sum);
    commands.dispatch_indirect(choose_, groups_, 6, sum);
    commands.dispatch_indirect(update_, groups_, 0, update);
  }
}

SphViscousResult sph_viscous_velocities(Context& context, const SphProblem& problem) {
  const SphConstants constants = sph_constants(problem);
  Neighbours neighbours(context, problem, constants);
  Densities densities(context, constants);
  ViscositySolver solver(context, problem, constants);
  const Buffer<vec4> positions(context, with_zero(problem.initial.positions));
  const Buffer<vec4> velocities(context, with_zero(problem.initial.velocities));
  const Buffer<vec4> accelerations(context, std::vector<vec4>(constants.count));
  SphClock clock{};
  clock.step = constants.fixed_step;
  const Buffer<SphClock> clock_buffer(context, std::vector<SphClock>{clock});
  context.run([&](Commands& commands) {
    neighbours.record(commands, positions);
    densities.record(commands, neighbours, velocities);
    solver.record(commands, neighbours, densities, accelerations, clock_buffer);
  });
  const std::vector<vec4> sorted = solver.solution().read();
  const std::vector<std::uint32_t> ids = neighbours.cells().ids().read();
  SphViscousResult result{std::vector<vec3>(sorted.size()), solver.solver().read()[0].iterations};
  for (std::size_t i = 0; i < sorted.size(); ++i) result.velocities[ids[i]] = vec3(sorted[i]);
  return result;
}

}  // namespace parity::gpu
