#pragma once

#include <array>

#include "gpu/numerics/pressure_system.h"

namespace parity::gpu {

/// Geometric multigrid: red-black Gauss-Seidel before and after, the residual's mean down, linear
/// interpolation up. Grids of at most `small_cells` cells are visited inside one workgroup.
/// Converges: a cycle takes the residual down about tenfold on boxes; solids and free surfaces slow
/// it, then it belongs inside conjugate gradients.
///
/// Source: notes 9.3; Trottenberg, Oosterlee & Schueller 2001; McAdams, Sifakis & Teran 2010.
class Multigrid {
 public:
  Multigrid(Context& context, PressureSystem& system);

  /// One V-cycle on the finest grid's pressure and right side.
  ///
  /// @param zero_guess  the pressure counts as 0; else its red cells must be relaxed, as a cycle
  ///                    leaves them.
  void record_cycle(Commands& commands, bool zero_guess);

  /// V-cycles, at most `cycles`, until the residual is within the control's tolerance.
  ///
  /// @param full  begin with full multigrid instead of the pressure that is there; not with tiles.
  void record_solve(Commands& commands, std::uint32_t cycles, bool full);

  static constexpr std::uint32_t small_cells = 16384;

 private:
  void record_down(Commands& commands, std::size_t level, bool zero_guess);
  void record_up(Commands& commands, std::size_t level);
  void record_cycle_from(Commands& commands, std::size_t first, bool zero_guess);
  void record_small(Commands& commands, std::uint32_t cycles);
  void record_transfer(Commands& commands, const Kernel<TransferArgs>& kernel, std::size_t fine,
                       bool down);
  void record_sweep(Commands& commands, const std::array<Kernel<SweepArgs>, 2>& kernels,
                    std::size_t level, std::uint32_t colour);

  PressureSystem& system_;
  std::size_t small_;  ///< first grid that is visited inside one workgroup
  /// Of the finest grid, which may be tiled, and of the others.
  std::array<Kernel<SweepArgs>, 2> smooth_, first_;
  Kernel<SweepArgs> measure_;
  std::array<Kernel<TransferArgs>, 2> restrict_residual_, prolong_red_;
  Kernel<TransferArgs> restrict_rhs_, prolong_both_;
  Kernel<SmallCycleArgs> small_cycle_;
  Buffer<PressureLevel> levels_;
};

/// Cycles to the tolerance, from the guess or by full multigrid. Float: a residual below about 1e-6
/// of rhs is out of reach.
///
/// Mathematics: cpu::multigrid.
PressureAnswer multigrid(Context& context, const PressureProblem& problem, bool full);

}  // namespace parity::gpu
