#include "gpu/numerics/multigrid.h"

#include <algorithm>

#include "shaders.h"

namespace parity::gpu {
namespace {

enum class Transfer : std::uint32_t { restrict_residual, restrict_rhs, prolong_red, prolong_both };

Kernel<TransferArgs> make_transfer(Context& context, const PressureSystem& system, Transfer mode,
                                   bool is_finest) {
  return Kernel<TransferArgs>(context, shaders::numerics_transfer_comp,
                              {{0, system.shape().with_words ? 1u : 0u},
                               {1, std::uint32_t(mode)},
                               {2, is_finest && system.tiles() != nullptr ? 1u : 0u}});
}

std::array<Kernel<TransferArgs>, 2> make_transfers(Context& context, const PressureSystem& system,
                                                   Transfer mode) {
  return {make_transfer(context, system, mode, true), make_transfer(context, system, mode, false)};
}

std::array<Kernel<SweepArgs>, 2> make_sweeps(Context& context, const PressureSystem& system,
                                             Sweep mode) {
  return {system.make_sweep(context, mode, true), system.make_sweep(context, mode, false)};
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
      smooth_(make_sweeps(context, system, Sweep::smooth_colour)),
      first_(make_sweeps(context, system, Sweep::first_colour)),
      measure_(system.make_sweep(context, Sweep::measure)),
      restrict_residual_(make_transfers(context, system, Transfer::restrict_residual)),
      prolong_red_(make_transfers(context, system, Transfer::prolong_red)),
      restrict_rhs_(make_transfer(context, system, Transfer::restrict_rhs, false)),
      prolong_both_(make_transfer(context, system, Transfer::prolong_both, false)),
      small_cycle_(context, shaders::numerics_small_cycle_comp,
                   {{0, system.shape().with_words ? 1u : 0u}}),
      levels_(context, system.levels()) {}

void Multigrid::record_transfer(Commands& commands, const Kernel<TransferArgs>& kernel,
                                std::size_t fine, bool down) {
  const PressureLevel& f = system_.levels()[fine];
  const PressureLevel& c = system_.levels()[fine + 1];
  const std::uint32_t threads =
      down ? (c.cells.x + 3) / 4 * c.cells.y * c.cells.z : f.row * f.cells.y * f.cells.z;
  const TransferArgs args{.fine = f,
                          .coarse = c,
                          .control = system_.control(),
                          .tiles = system_.tile_table(),
                          .mode = 0,
                          .padding = 0};
  if (fine == 0 && system_.tiles() != nullptr) {
    system_.tiles()->dispatch(commands, kernel, down ? tile_rows : tile_quads, args);
  } else {
    commands.dispatch(kernel, {threads}, args);
  }
}

void Multigrid::record_sweep(Commands& commands, const std::array<Kernel<SweepArgs>, 2>& kernels,
                             std::size_t level, std::uint32_t colour) {
  system_.record_sweep(commands, kernels[level == 0 ? 0 : 1], system_.levels()[level], colour, 1);
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
  if (zero_guess) record_sweep(commands, first_, level, 0);
  record_sweep(commands, smooth_, level, 1);
  record_transfer(commands, restrict_residual_[level == 0 ? 0 : 1], level, true);
}

void Multigrid::record_up(Commands& commands, std::size_t level) {
  record_transfer(commands, prolong_red_[level == 0 ? 0 : 1], level, false);
  record_sweep(commands, smooth_, level, 1);
  record_sweep(commands, smooth_, level, 0);
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
      record_sweep(commands, smooth_, level, 0);
      if (level > 0) record_cycle_from(commands, level, false);
    }
  } else {
    record_sweep(commands, smooth_, 0, 0);
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
