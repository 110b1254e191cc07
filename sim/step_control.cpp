#include "sim/step_control.h"

#include <algorithm>
#include <cmath>

namespace parity {

double step_error(double difference, double size, int order) {
  if (difference == 0) return 0;
  return difference / size / (std::exp2(order) - 1);
}

double trial_step(const StepControl& control, double stable, double left) {
  const double step = control.allowed > 0 ? std::min(control.allowed, stable) : stable;
  if (left >= 2 * step) return step;
  return left > step ? 0.5 * left : left;
}

bool settle_step(StepControl& control, double error, double tolerance, double step, double stable,
                 int order) {
  const double shortest = stable / 1024;
  const double growth = 0.9 * std::pow(tolerance / error, 1.0 / (order + 1));
  const double factor = std::isnan(growth) ? 0.2 : std::clamp(growth, 0.2, 2.0);
  const double next = std::max(factor * step, shortest);
  // The margin is for clocks of floats.
  const bool is_taken = error <= tolerance || step <= 1.001 * shortest;
  if (!is_taken) ++control.refused;
  const bool was_cut = is_taken && step < control.allowed;
  control.allowed = was_cut ? std::max(next, control.allowed) : next;
  return is_taken;
}

}  // namespace parity
