#pragma once

#include "sim/fluid.h"

namespace parity::cpu {

/// du/dt of every face without pressure: divergence of the flux of momentum (upwind or central),
/// viscosity and force; 0 in closed walls. Central differences on the staggered grid keep momentum
/// and, at rest in time, kinetic energy.
///
/// Accuracy: O(h^2) central, O(h) upwind.
/// Source: notes 10.4; Harlow & Welch 1965.
FaceFields momentum_rate(const FluidProblem& problem, const FaceFields& velocity);

/// Sum of the second differences over h^2, of every face; walls as in momentum_rate.
FaceFields laplacian(const FluidDomain& domain, const FaceFields& velocity);

/// viscosity * step added explicitly. Stable iff step <= h^2 / (2 d viscosity).
///
/// Erratum: notes 10.4 gives viscosity * step <= h^2 / 2, which is right in one dimension only.
FaceFields diffuse_explicit(const FluidDomain& domain, const FaceFields& velocity, double viscosity,
                            double step);

/// (1 - step viscosity Laplacian) u = velocity, by Gauss-Seidel to 1e-10 of the largest change. Any
/// step is stable.
FaceFields diffuse_implicit(const FluidDomain& domain, const FaceFields& velocity, double viscosity,
                            double step);

}  // namespace parity::cpu
