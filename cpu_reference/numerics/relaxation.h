#pragma once

#include "sim/pressure.h"

namespace parity::cpu {

/// Jacobi: each cell takes the value that its own equation gives from the old values of the others,
/// times omega, plus (1 - omega) of its own.
///
/// Converges iff the spectral radius is below 1: for the closed box cos(pi / n) of an n-cell axis
/// (up to the constant), for 0 < omega <= 1. On a free or Dirichlet line of n unknowns
/// cos(pi / (n + 1)).
/// @return  iterations, residual and whether the tolerance was met within max_iterations.
///
/// Source: notes 9.3. Differs from the notes: L and U there are the strict triangles.
PressureAnswer jacobi(const PressureProblem& problem, double omega);

/// Gauss-Seidel, over-relaxed by omega: fresh values are used at once, cells in order of storage.
/// Converges for 0 < omega < 2.
///
/// Source: notes 9.3; Young 1954.
PressureAnswer gauss_seidel(const PressureProblem& problem, double omega);

}  // namespace parity::cpu
