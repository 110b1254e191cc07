#pragma once

#include <cstdint>

/// Steps as long as their error allows, by step doubling: one step against two of half the length.
namespace parity {

/// What stays from step to step; part of a checkpoint.
struct StepControl {
  double allowed = 0;         ///< s that the last error allows the next step; 0: not known yet
  std::uint64_t refused = 0;  ///< steps taken back so far
};

/// Error of the two half steps, from how far one whole step ends from them, as a part of `size`:
/// the whole step's error is 2^order times theirs. 0 where nothing differs.
///
/// Source: Hairer, Norsett & Wanner 1993, II.4.
double step_error(double difference, double size, int order);

/// The step to try: `stable` or what the error allows, whichever is shorter. The last two before
/// the end, `left` s away, are equal, so that none is tiny.
double trial_step(const StepControl& control, double stable, double left);

/// Is a step with that error taken? If its error is at most the tolerance, or if it is no longer
/// than 1/1024 of the stable one: what is left there is rounding and the pressure solver's. What is
/// allowed next is step clamp(0.9 (tolerance / error)^(1 / (order + 1)), 0.2, 2), and after a step
/// that `stable` or the end cut short at least what was allowed before.
bool settle_step(StepControl& control, double error, double tolerance, double step, double stable,
                 int order);

}  // namespace parity
