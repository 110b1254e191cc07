#pragma once

#include "gpu/core/context.h"
#include "sim/ode.h"

namespace parity::gpu {

/// Steps of many systems at once, one thread each; the batch stays on the device until all are at
/// their end.
///
/// @throws std::invalid_argument  as check_ode_problem.
/// @throws Error                  the adaptive method has not come to the end in 2^20 steps.
///
/// Mathematics: cpu::integrate. Precision: float, with compensated sums of state and time: some
/// 2^-23 of the change of each step, not of the state.
OdeResult integrate(Context& context, const OdeProblem& problem);

}  // namespace parity::gpu
