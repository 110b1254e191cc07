#include <gtest/gtest.h>

#include <array>
#include <string>

#include "gpu/fluid/step.h"
#include "tests/gpu_context.h"

/// What a liquid on a grid may do with its energy: lose it.
namespace parity {
namespace {

/// Kinetic energy of the particles and potential energy above the floor, J.
double total_energy(const FluidProblem& problem, const FluidState& state) {
  double lift = 0;
  for (const vec3 position : state.particles.positions)
    lift -= glm::dot(problem.parameters.force, dvec3(position) - problem.domain.origin);
  return measure(problem, state).kinetic_energy + liquid_particle_mass(problem) * lift;
}

struct LiquidKind {
  const char* name;
  FluidMethod method;
  double flip_ratio;
};
constexpr std::array<LiquidKind, 3> liquid_kinds = {LiquidKind{"flip", FluidMethod::flip, 0.97},
                                                    LiquidKind{"apic", FluidMethod::apic, 0},
                                                    LiquidKind{"pic", FluidMethod::flip, 0}};

/// Walls and the pressure of a flow without divergence do no work. What the projection leaves of
/// it, D, lets the pressure of the column, at most rho g H in the mean over a long time, do
/// rho g H D V a second; the column begins with rho g H V / 2. Gravity and motion, taken in turns,
/// lose energy (below).
double largest_gain(const FluidProblem& problem, double seconds) {
  return 2 * problem.parameters.divergence * seconds;
}

class LiquidEnergy : public testing::TestWithParam<LiquidKind> {};

TEST_P(LiquidEnergy, ADamThatBreaksNeverGains) {
  FluidProblem problem = dam_break(6, 1, 2);
  problem.parameters.method = GetParam().method;
  problem.parameters.flip_ratio = GetParam().flip_ratio;
  problem.parameters.max_iterations = 8;
  const double first = total_energy(problem, problem.initial), end = 2.5;
  double before = first;
  gpu::FluidSimulation simulation(test_context(), problem);
  for (double time = end / 10; time < end * 1.01; time += end / 10) {
    EXPECT_EQ(simulation.run_until(time, 16, 1000).unconverged, 0u);
    const FluidState state = simulation.read();
    ASSERT_NEAR(state.time, time, 1e-3);
    const double now = total_energy(problem, state);
    // What is not a number is no less either.
    ASSERT_LE(now, before + first * largest_gain(problem, end / 10))
        << "at " << time << " s, begun with " << first;
    before = now;
  }
}

/// v -= g dt and then y += v dt change the energy of a fall by -(g dt)^2 / 2 a step: an error of
/// the first order in the step, of the sign that no run can blow up by.
TEST_P(LiquidEnergy, AFallLosesWhatSplittingCostsInProportionToTheStep) {
  FluidProblem problem = dam_break(8, 1, 2);
  problem.initial.particles = {};
  add_liquid(problem, {1.5, 1.2, 0}, {2.5, 2.2, 1});
  problem.parameters.method = GetParam().method;
  problem.parameters.flip_ratio = GetParam().flip_ratio;
  for (vec3& v : problem.initial.particles.velocities) v = {0.25f, 0.5f, 0};
  const double mass = measure(problem, problem.initial).mass, seconds = 0.125, g = 9.81;
  const double first = total_energy(problem, problem.initial);
  for (const int steps : {4, 8, 16}) {
    problem.parameters.fixed_step = seconds / steps;
    gpu::FluidSimulation simulation(test_context(), problem);
    EXPECT_EQ(simulation.run_until(seconds, 4).steps, std::uint32_t(steps));
    const double gain = (total_energy(problem, simulation.read()) - first) / mass;
    // Places of up to 3 m under 9.81 m/s^2 and speeds of 1 m/s round in a dozen operations a step.
    EXPECT_NEAR(gain, -g * g * seconds * seconds / steps / 2, steps * 12 * 30 * 0x1p-24);
  }
}

INSTANTIATE_TEST_SUITE_P(Grid, LiquidEnergy, testing::ValuesIn(liquid_kinds),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace parity
