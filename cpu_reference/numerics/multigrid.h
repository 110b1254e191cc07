#pragma once

#include "sim/pressure.h"

namespace parity::cpu {

/// Multigrid W(2, 2)-cycles with symmetric Gauss-Seidel; coarse cells are blocks of up to 2 x 2 x
/// 2, their equations the sums of the fine ones (Galerkin) over a factor of 2 that mends the jump
/// of piecewise constant interpolation.
///
/// Converges: by a factor of 2 to 5 a cycle, whatever the number of cells.
/// Source: notes 9.3; Trottenberg, Oosterlee & Schueller 2001; Braess 1995 for the factor.
PressureAnswer multigrid(const PressureProblem& problem);

}  // namespace parity::cpu
