#pragma once

#include <functional>

#include "sim/ode.h"

namespace parity::cpu {

/// The systems of a problem, each stepped to the end.
///
/// @throws std::invalid_argument  as check_ode_problem, or the adaptive method has not come to the
///                                end in 2^20 steps.
///
/// Stable iff |R(h lambda)| <= 1 for x' = lambda x, with R = 1 + z (explicit Euler), 1 / (1 - z)
/// (implicit Euler), (1 + z/2) / (1 - z/2) (trapezoid), 1 + z + z^2/2 (midpoint), the series of e^z
/// to z^4 (RK4); symplectic Euler iff omega h < 2 for oscillators.
/// Accuracy: orders 1, 1, 1, 2, 2, 4, and 5 in the tolerance's step.
/// Source: notes 10.1; Dormand & Prince 1980; Gustafsson 1991.
/// Errata: the notes' stability test 1 + lambda h < 1 has lost its bars: with it every step would
/// be stable for lambda < 0. Symplectic Euler does not preserve the energy but one near it, see
/// symplectic_energy. The trapezoid is A-stable, yet rings: R(-inf) = -1.
OdeResult integrate(const OdeProblem& problem);

/// x' = f(x, t) as a function.
using OdeSlope = std::function<dvec2(const dvec2& state, double t)>;
OdeSlope ode_slope(OdeSystem system, const OdeInstance& instance);

/// What symplectic Euler conserves exactly for the oscillator of angular frequency w: y^2 / 2 + w^2
/// x^2 / 2 - h w^2 x y / 2.
///
/// Source: Hairer, Lubich & Wanner 2006, example IX.1.4.
double symplectic_energy(const OdeInstance& instance, const dvec2& state, double step);

}  // namespace parity::cpu
