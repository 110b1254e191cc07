#include "gpu/numerics/multigrid.h"

#include <algorithm>

#include "shaders.h"

namespace parity::gpu {
namespace {

enum class Transfer : std::uint32_t { restrict_residual, restrict_rhs, prolong_red, prolong_both };

Kernel<TransferArgs> make_transfer(Context& context, const PressureSystem& system, Transfer mode) {
  return Kernel<TransferArgs>(context, shaders::numerics_transfer_comp,
                              {{0, system.shape().with_words ? 1u : 0u}, {1, std::uint32_t(mode)}});
}

/// The first grid of at most small_cells cells; the last one at least.
std::size_t first_small(const PressureSystem& system) {
  std::size_t level = 0;
  const auto cells = [&](std::size_t l) {
    const uvec3 n = system.levels()[l].cells;
    return std::size_t{n.x} * n.y * n.z;
  };
  while (level + 1 < system.levels().size() && cells(level) > Multigrid::small_cells) ++level;
  return level;
}

}  // namespace

Multigrid::Multigrid(Context& context, PressureSystem& system)
    : system_(system),
      small_(first_small(system)),
      smooth_(system.make_sweep(context, Sweep::smooth_colour)),
      first_(system.make_sweep(context, Sweep::first_colour)),
      measure_(system.make_sweep(context, Sweep::measure)),
      restrict_residual_(make_transfer(context, system, Transfer::restrict_residual)),
      restrict_rhs_(make_transfer(context, system, Transfer::restrict_rhs)),
      prolong_red_(make_transfer(context, system, Transfer::prolong_red)),
      prolong_both_(make_transfer(context, system, Transfer::prolong_both)),
      small_cycle_(context, shaders::numerics_small_cycle_comp,
                   {{0, system.shape().with_words ? 1u : 0u}}),
      levels_(context, system.levels()) {}

void Multigrid::record_transfer(Commands& commands, const Kernel<TransferArgs>& kernel,
                                std::size_t fine, bool down) {
  const PressureLevel& f = system_.levels()[fine];
  const PressureLevel& c = system_.levels()[fine + 1];
  const std::uint32_t threads =
      down ? (c.cells.x + 3) / 4 * c.cells.y * c.cells.z : f.row * f.cells.y * f.cells.z;
  commands.dispatch(
      kernel, {threads},
      {.fine = f, .coarse = c, .control = system_.control(), .mode = 0, .padding = 0});
}

void Multigrid::record_small(Commands& commands, std::uint32_t cycles) {
  const uvec3 last = system_.levels().back().cells;
  commands.dispatch(small_cycle_, {256},
                    {.levels = levels_,
                     .control = system_.control(),
                     .first = std::uint32_t(small_),
                     .count = std::uint32_t(system_.levels().size()),
                     .cycles = cycles,
                     .sweeps = std::clamp(2 * std::max({last.x, last.y, last.z}), 4u, 64u)});
}

void Multigrid::record_down(Commands& commands, std::size_t level, bool zero_guess) {
  const PressureLevel& grid = system_.levels()[level];
  if (zero_guess) system_.record_sweep(commands, first_, grid, 0, 1);
  system_.record_sweep(commands, smooth_, grid, 1, 1);
  record_transfer(commands, restrict_residual_, level, true);
}

void Multigrid::record_up(Commands& commands, std::size_t level) {
  const PressureLevel& grid = system_.levels()[level];
  record_transfer(commands, prolong_red_, level, false);
  system_.record_sweep(commands, smooth_, grid, 1, 1);
  system_.record_sweep(commands, smooth_, grid, 0, 1);
}

void Multigrid::record_cycle_from(Commands& commands, std::size_t first, bool zero_guess) {
  for (std::size_t level = first; level < small_; ++level)
    record_down(commands, level, zero_guess || level > first);
  record_small(commands, 0);
  for (std::size_t level = small_; level > first; --level) record_up(commands, level - 1);
}

void Multigrid::record_cycle(Commands& commands, bool zero_guess) {
  record_cycle_from(commands, 0, zero_guess);
}

void Multigrid::record_solve(Commands& commands, std::uint32_t cycles, bool full) {
  if (small_ == 0) {
    record_small(commands, cycles);
    return;
  }
  if (full) {
    for (std::size_t level = 0; level < small_; ++level)
      record_transfer(commands, restrict_rhs_, level, true);
    record_small(commands, 0);
    for (std::size_t level = small_; level-- > 0;) {
      record_transfer(commands, prolong_both_, level, false);
      system_.record_sweep(commands, smooth_, system_.levels()[level], 0, 1);
      if (level > 0) record_cycle_from(commands, level, false);
    }
  } else {
    system_.record_sweep(commands, smooth_, system_.finest(), 0, 1);
  }
  for (std::uint32_t cycle = 0; cycle < cycles; ++cycle) {
    record_cycle(commands, false);
    system_.record_sweep(commands, measure_, system_.finest(), 0, 1);
    system_.record_reduce(commands, Reduction::cycle_residual, system_.sweep_partials());
  }
}

PressureAnswer multigrid(Context& context, const PressureProblem& problem, bool full) {
  PressureSystem system(context, shape_of(problem));
  Multigrid solver(context, system);
  system.upload(context, problem);
  // A few cycles at a time, so that a solve that converges early is not recorded to its end.
  int cycles = 0;
  do {
    const int more = std::min(4, problem.max_iterations - cycles);
    context.run([&](Commands& commands) {
      solver.record_solve(commands, std::uint32_t(more), full && cycles == 0);
    });
    cycles += more;
  } while (cycles < problem.max_iterations && system.read_control().done == 0);
  return system.download();
}

}  // namespace parity::gpu
