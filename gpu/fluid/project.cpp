#include "gpu/fluid/project.h"

#include <algorithm>

#include "shaders.h"

namespace parity::gpu {
namespace {

std::vector<Specialization> solids_of(const FluidBuffers& buffers) {
  return {{0, buffers.with_solids ? 1u : 0u}, buffers.tiled()};
}

bool has_open_side(const FluidDomain& domain) {
  return std::ranges::any_of(domain.walls,
                             [](const Wall& wall) { return wall.kind == WallKind::open; });
}

}  // namespace

Projection::Projection(Context& context, FluidBuffers& buffers, const FluidProblem& problem)
    : buffers_(buffers),
      system_(context, shape_of(problem.domain, buffers.with_solids), buffers.tiles.get()),
      divergence_(context, shaders::fluid_divergence_comp, solids_of(buffers)),
      subtract_(context, shaders::fluid_subtract_gradient_comp, solids_of(buffers)),
      start_(context, shaders::fluid_start_solve_comp),
      keep_tiles_(buffers.tiles && !is_liquid(problem.parameters.method)),
      iterations_(problem.parameters.max_iterations),
      remove_mean_(!has_open_side(problem.domain) && !problem.solids.empty() &&
                   !is_liquid(problem.parameters.method)) {
  // Where a force is held by pressure, differences count that one float is too coarse for.
  const FluidParameters& p = problem.parameters;
  if (buffers.with_solids || (is_split(p.method) && p.force != dvec3(0))) {
    conjugate_gradient_ =
        std::make_unique<ConjugateGradient>(context, system_, Preconditioner::multigrid);
  } else {
    multigrid_ = std::make_unique<Multigrid>(context, system_);
  }
}

void Projection::write_pressure(const Field& pressure) { system_.write_pressure(pressure); }

FluidProjectArgs Projection::args(const FluidFaces& velocity) const {
  return {.scene = buffers_.scene,
          .clock = buffers_.clock,
          .velocity = velocity,
          .open = buffers_.open,
          .boundary = buffers_.boundary,
          .types = buffers_.types,
          .pressure = system_.rhs(),
          .pressure_low = {},
          .control = system_.control(),

          .mode = 0,
          .part = 1};
}

void Projection::record_cells(Commands& commands) {
  system_.record_pack(commands, buffers_.types,
                      {buffers_.open[0].ref(), buffers_.open[1].ref(), buffers_.open[2].ref()},
                      keep_tiles_);
}

void Projection::record(Commands& commands, const FluidFaces& velocity, float part) {
  FluidProjectArgs now = args(velocity);
  now.part = part;
  commands.dispatch(start_, {1}, now);
  if (buffers_.tiles) {
    buffers_.dispatch(commands, divergence_, 3, now);
  } else {
    commands.dispatch(divergence_, {4 * system_.quad_count()}, now);
  }
  if (multigrid_) {
    multigrid_->record_solve(commands, iterations_, false);
  } else {
    conjugate_gradient_->record_solve(commands, iterations_, remove_mean_);
    now.pressure_low = conjugate_gradient_->pressure_low();
  }
  now.mode = 1;
  commands.dispatch(start_, {1}, now);
  now.pressure = system_.pressure();
  for (std::uint32_t axis = 0; axis < (buffers_.cells.z > 1 ? 3u : 2u); ++axis) {
    now.mode = 2 * axis + (multigrid_ ? 0 : 1);
    buffers_.dispatch(commands, subtract_, axis, now);
  }
}

}  // namespace parity::gpu
