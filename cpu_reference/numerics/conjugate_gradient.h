#pragma once

#include <vector>

#include "sim/pressure.h"

namespace parity::cpu {

enum class Preconditioner : std::uint32_t { none, jacobi, incomplete_cholesky };

/// Preconditioned conjugate gradients. Incomplete Cholesky is modified: 97 % of the fill that is
/// dropped goes to the diagonal.
///
/// Converges: without rounding in at most as many steps as there are different eigenvalues; the
/// error's A-norm falls at every step, by (sqrt(kappa) - 1) / (sqrt(kappa) + 1) or more.
/// Source: notes 9.3; Hestenes & Stiefel 1952; Bridson 2015, 5.3.
PressureAnswer conjugate_gradient(const PressureProblem& problem, Preconditioner preconditioner);

}  // namespace parity::cpu
