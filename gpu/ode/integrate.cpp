#include "gpu/ode/integrate.h"

#include <algorithm>
#include <string>

#include "gpu/core/buffer.h"
#include "gpu/core/commands.h"
#include "gpu/core/kernel.h"
#include "shaders.h"
#include "shaders/ode/layout.h"

namespace parity::gpu {
namespace {

/// With 12 rounds of Newton's method each, below the 65,535 iterations that every driver runs.
constexpr std::uint32_t steps_a_dispatch = 4096;
constexpr std::uint32_t most_adaptive_steps = 1u << 20;

std::vector<OdeRecord> records_of(const OdeProblem& problem) {
  std::vector<OdeRecord> records;
  for (const OdeInstance& instance : problem.instances)
    records.push_back({.state = instance.initial,
                       .carry = vec2(0),
                       .parameters = instance.parameters,
                       .time = 0,
                       .time_carry = 0,
                       .step = float(problem.step),
                       .old_error = 1,
                       .steps = 0,
                       .evaluations = 0});
  return records;
}

}  // namespace

OdeResult integrate(Context& context, const OdeProblem& problem) {
  check_ode_problem(problem);
  const bool adaptive = problem.method == OdeMethod::dormand_prince;
  const auto count = std::uint32_t(problem.instances.size());
  const Kernel<OdeArgs> kernel(
      context, shaders::ode_integrate_comp,
      {{0, std::uint32_t(problem.method)}, {1, std::uint32_t(problem.system)}});
  Buffer<OdeRecord> records(context, records_of(problem));
  const auto end = float(problem.step * problem.steps);
  std::uint32_t left = adaptive ? most_adaptive_steps : problem.steps;
  const auto at_end = [&](const OdeRecord& record) { return record.time >= end; };
  bool done = count == 0 || problem.steps == 0;
  while (!done) {
    const std::uint32_t now = std::min(left, steps_a_dispatch);
    context.run([&](Commands& commands) {
      commands.dispatch(kernel, {count},
                        {.records = records,
                         .count = count,
                         .steps = now,
                         .last_step = problem.steps,
                         .step = float(problem.step),
                         .end = end,
                         .tolerance = float(problem.tolerance)});
    });
    left -= now;
    done = adaptive ? std::ranges::all_of(records.read(), at_end) : left == 0;
    if (!done && left == 0)
      throw Error(ErrorKind::other,
                  "ode: not at the end after " + std::to_string(most_adaptive_steps) + " steps");
  }
  OdeResult result;
  for (const OdeRecord& record : records.read()) {
    result.states.push_back(dvec2(record.state) + dvec2(record.carry));
    result.evaluations.push_back(record.evaluations);
  }
  return result;
}

}  // namespace parity::gpu
