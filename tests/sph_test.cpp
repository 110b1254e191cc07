#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>

#include "cpu_reference/sph/forces.h"
#include "cpu_reference/sph/gradient.h"
#include "cpu_reference/sph/pressure.h"
#include "cpu_reference/sph/step.h"
#include "gpu/sph/constants.h"
#include "gpu/sph/gradient.h"
#include "gpu/sph/step.h"
#include "tests/gpu_context.h"
#include "tests/shared_data.h"
#include "tests/sph/problems.h"

namespace parity {
namespace {

using sph_test::u;

constexpr SphKernel kernels[] = {SphKernel::cubic_spline, SphKernel::poly6, SphKernel::spiky,
                                 SphKernel::wendland};

TEST(SphKernels, IntegrateToOneAndHaveTheirDerivatives) {
  constexpr int steps = 20000;
  constexpr double support = 0.7;
  for (const SphKernel kernel : kernels)
    for (const std::uint32_t d : {2u, 3u}) {
      double sum = 0;
      for (int k = 0; k < steps; ++k) {
        const double r = support * (k + 0.5) / steps;
        const double shell = d == 3 ? 4 * std::numbers::pi * r * r : 2 * std::numbers::pi * r;
        sum += shell * cpu::sph_kernel(kernel, d, r, support) * support / steps;
        const double slope = (cpu::sph_kernel(kernel, d, r + 1e-6, support) -
                              cpu::sph_kernel(kernel, d, r - 1e-6, support)) /
                             2e-6;
        const double peak = cpu::sph_kernel(kernel, d, 0, support) / support;
        if (k % 500 == 250) {
          EXPECT_NEAR(cpu::sph_kernel_derivative(kernel, d, r, support), slope, 1e-4 * peak);
        }
      }
      EXPECT_NEAR(sum, 1, 1e-7);
      EXPECT_EQ(cpu::sph_kernel(kernel, d, support, support), 0);
    }
}

TEST(SphKernels, HaveTheTabulatedPeaks) {
  const auto path = shared_data("reference/sph_kernels.csv");
  if (!path) GTEST_SKIP() << "skipped: no shared data";
  std::ifstream file(*path);
  std::string line;
  int found = 0;
  while (std::getline(file, line)) {
    const auto ours = [&](const char* name, SphKernel kernel, std::uint32_t d) {
      const std::string start = std::string(name) + "," + std::to_string(d) + ",";
      if (!line.starts_with(start)) return;
      EXPECT_NEAR(cpu::sph_kernel(kernel, d, 0, 2), std::stod(line.substr(start.size())), 1e-11);
      ++found;
    };
    for (const std::uint32_t d : {2u, 3u}) {
      ours("cubic_spline", SphKernel::cubic_spline, d);
      ours("wendland_C2(q<=2)", SphKernel::wendland, d);
    }
  }
  EXPECT_EQ(found, 4);
}

/// The middle of a block on its lattice, seen by the device: sum of W V is 1.
TEST(SphKernels, FillSpaceOnALattice) {
  for (const SphKernel kernel : kernels)
    for (const std::uint32_t d : {2u, 3u}) {
      SphProblem problem = sph_random_drop(d, 9, 0, 1);
      problem.initial.positions =
          fill_box({dvec3(-0.5), dvec3(0.5)}, problem.parameters.spacing, d);
      problem.parameters.kernel = kernel;
      problem.parameters.support = 3.9 * problem.parameters.spacing;
      const std::vector<float> densities = gpu::sph_densities(test_context(), problem);
      // 9 x 9 (x 9): the middle particle. Sums of smooth functions converge fast, spiky has a cusp.
      EXPECT_NEAR(densities[densities.size() / 2] / problem.parameters.rest_density, 1,
                  kernel == SphKernel::spiky ? 0.04 : 0.002)
          << int(kernel) << " in " << d;
    }
}

TEST(SphDensity, FluidAtRestBesideAWallHasItsRestDensity) {
  for (const std::uint32_t d : {2u, 3u}) {
    const SphProblem problem = sph_dam_break(d, 0.1, 8);
    const std::vector<float> densities = gpu::sph_densities(test_context(), problem);
    for (std::size_t i = 0; i < densities.size(); ++i) {
      const vec3 at = problem.initial.positions[i];
      // Not at edges and corners, where walls crowd, nor at the surface.
      const bool edge = at.y < 0.02f || at.y > 0.18f || at.x > 0.08f ||
                        (d == 3 && (at.z < 0.02f || at.z > 0.08f));
      if (!edge) {
        EXPECT_NEAR(densities[i] / 1000, 1, 2e-3) << at.x << " " << at.y;
      }
      EXPECT_LT(densities[i] / 1000, 1.04);
    }
  }
}

gpu::SphStep run_steps(const SphProblem& problem, int steps) {
  gpu::SphStep step(test_context(), problem);
  test_context().run([&](gpu::Commands& commands) {
    for (int k = 0; k < steps; ++k) step.record(commands, 1e9);
  });
  return step;
}

/// Pair forces cancel exactly; what remains is the rounding of the sums: n u of a kick for each
/// particle, and u of its velocity, in every step.
TEST(SphStep, KeepsMomentumToRoundingAndMassExactly) {
  for (const SphMethod method : {SphMethod::weakly_compressible, SphMethod::divergence_free}) {
    SphProblem problem = sph_random_drop(3, 8, 0.5, 7);
    problem.parameters.method = method;
    problem.parameters.viscosity = 0.01;
    problem.parameters.max_iterations = 10;
    constexpr int steps = 20;
    const SphState end = run_steps(problem, steps).read();
    const SphMeasures before = measure(problem.parameters, problem.initial);
    const SphMeasures after = measure(problem.parameters, end);
    EXPECT_EQ(before.mass, after.mass);
    const double speed = std::max(before.max_speed, after.max_speed);
    const double bound = steps * before.mass * u * (speed + 60 * 2 * speed);
    EXPECT_LT(glm::length(after.momentum - before.momentum), bound);
    EXPECT_GT(glm::length(dvec3(end.velocities[0] - problem.initial.velocities[0])), 1e-3);
  }
}

std::uint64_t hash_of(const SphState& state) {
  std::uint64_t hash = 14695981039346656037ULL;
  const auto add = [&](const void* bytes, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i)
      hash = (hash ^ static_cast<const unsigned char*>(bytes)[i]) * 1099511628211ULL;
  };
  add(&state.time, sizeof state.time);
  add(state.positions.data(), state.positions.size() * sizeof(vec3));
  add(state.velocities.data(), state.velocities.size() * sizeof(vec3));
  return hash;
}

SphProblem stirred(SphMethod method) {
  SphProblem problem =
      sph_test::stirred_tank(3, 6, SphKernel::cubic_spline, 2, SphEquationOfState::tait, 5);
  problem.parameters.method = method;
  problem.parameters.max_iterations = 5;
  return problem;
}

TEST(SphStep, GivesTheSameBitsAgainAndFromACheckpoint) {
  for (const SphMethod method : {SphMethod::weakly_compressible, SphMethod::divergence_free}) {
    const SphProblem problem = stirred(method);
    const std::uint64_t whole = hash_of(run_steps(problem, 8).read());
    EXPECT_EQ(whole, hash_of(run_steps(problem, 8).read()));
    SphProblem rest = problem;
    rest.initial = run_steps(problem, 3).read();
    gpu::SphStep again(test_context(), problem);
    again.write(rest.initial);
    test_context().run([&](gpu::Commands& commands) {
      for (int k = 0; k < 5; ++k) again.record(commands, 1e9);
    });
    EXPECT_EQ(whole, hash_of(again.read()));
  }
}

TEST(SphStep, GivesTheSameBitsOnAnyNumberOfThreads) {
  const SphProblem problem = stirred(SphMethod::weakly_compressible);
  const std::uint64_t want = hash_of(run_steps(problem, 5).read());
  for (const char* threads : {"0", "1", "4"}) {
    setenv("LP_NUM_THREADS", threads, 1);
    gpu::Context context;
    unsetenv("LP_NUM_THREADS");
    gpu::SphStep step(context, problem);
    context.run([&](gpu::Commands& commands) {
      for (int k = 0; k < 5; ++k) step.record(commands, 1e9);
    });
    EXPECT_EQ(hash_of(step.read()), want) << threads;
  }
}

TEST(SphStep, ReachesTheTimeExactlyAndStays) {
  const SphProblem problem = stirred(SphMethod::weakly_compressible);
  gpu::SphStep step(test_context(), problem);
  const double until = 1e-3;
  const gpu::SphReport report = gpu::advance(test_context(), step, until, 1000);
  EXPECT_NEAR(report.time, until, until * 0x1p-40);
  const std::uint64_t hash = hash_of(step.read());
  test_context().run([&](gpu::Commands& commands) { step.record(commands, until); });
  EXPECT_EQ(hash, hash_of(step.read()));
  EXPECT_THROW(gpu::advance(test_context(), step, 1e3, 4), gpu::Error);
}

TEST(SphStep, EdgesOfTheInput) {
  SphProblem none = sph_dam_break(2, 0.1, 4);
  none.initial = {};
  EXPECT_TRUE(run_steps(none, 2).read().positions.empty());
  EXPECT_TRUE(gpu::sph_densities(test_context(), none).empty());
  SphProblem bad = sph_dam_break(2, 0.1, 4);
  bad.parameters.viscosity = -1;
  EXPECT_THROW(gpu::SphStep(test_context(), bad), std::invalid_argument);
  gpu::SphStep step(test_context(), sph_dam_break(2, 0.1, 4));
  EXPECT_THROW(step.write({}), std::invalid_argument);
}

/// As many cells as a million particles have in a tank seven times as large: more than a dispatch
/// along one axis takes.
TEST(SphNeighbours, AreFoundInALargeTank) {
  SphProblem problem = sph_dam_break(3, 0.5, 6);
  problem.domain.high = dvec3(problem.parameters.spacing * 2 * 100);
  SphNeighbourLists want = cpu::sph_neighbours(problem);
  EXPECT_EQ(want.fluid, gpu::sph_neighbours(test_context(), problem).fluid);
}

/// Memory of a million particles, from what a run of few takes: buffers are linear in the
/// particles. A list of 72 neighbours is 288 B, a dozen vec4 192 B, cells of half a support in a
/// tank seven times as large as the fluid 60 B; a tenth for walls.
TEST(SphStep, AMillionParticlesFitIntoAGibibyte) {
  gpu::Context context;
  const auto bytes_of = [&](int count) {
    SphProblem problem = sph_dam_break(3, 0.5, count);
    const std::uint64_t before = context.memory_bytes();
    const gpu::SphStep step(context, problem);
    return std::pair{double(context.memory_bytes() - before),
                     double(problem.initial.positions.size())};
  };
  const auto [few_bytes, few] = bytes_of(20);
  const auto [many_bytes, many] = bytes_of(32);
  const double per_particle = (many_bytes - few_bytes) / (many - few);
  EXPECT_LT(per_particle, 1.1 * (288 + 192 + 60));
  EXPECT_LT(many_bytes / many * 1e6, double(1 << 30));
}

/// Value at T of one experiment, between its points; NaN outside them.
double between_points(const std::vector<std::pair<double, double>>& points, double t) {
  for (std::size_t i = 1; i < points.size(); ++i)
    if (points[i - 1].first <= t && t <= points[i].first)
      return std::lerp(points[i - 1].second, points[i].second,
                       (t - points[i - 1].first) / (points[i].first - points[i - 1].first));
  return NAN;
}

std::map<std::string, std::vector<std::pair<double, double>>> dam_break_experiments(
    const std::filesystem::path& path) {
  std::map<std::string, std::vector<std::pair<double, double>>> experiments;
  std::ifstream file(path);
  std::string line;
  while (std::getline(file, line)) {
    std::istringstream row(line);
    std::string name, t, z;
    if (line.starts_with("#") || line.starts_with("dataset")) continue;
    if (std::getline(row, name, ',') && std::getline(row, t, ',') && std::getline(row, z, ','))
      experiments[name].emplace_back(std::stod(t), std::stod(z));
  }
  return experiments;
}

/// The band is between the two columns of Martin & Moyce; digitising is good to 0.02, and a front
/// of particles to a support, 0.1 column widths.
TEST(SphStep, TheDamBreaksAsMartinAndMoyceMeasured) {
  const auto path = shared_data("reference/dam_break_front.csv");
  if (!path) GTEST_SKIP() << "skipped: no shared data";
  const auto experiments = dam_break_experiments(*path);
  ASSERT_EQ(experiments.size(), 2u);
  constexpr double width = 0.05715;
  SphProblem problem = sph_dam_break(2, width, 20);
  problem.parameters.courant = 0.9;
  gpu::SphStep step(test_context(), problem);
  for (const double t : {1.0, 1.5, 2.0, 2.5, 3.0}) {
    gpu::advance(test_context(), step, t * std::sqrt(width / (2 * 9.81)), 100000);
    const SphMeasures measures = measure(problem.parameters, step.read());
    const double front = (measures.high.x + problem.parameters.spacing / 2) / width;
    double low = INFINITY, high = -INFINITY;
    for (const auto& [name, points] : experiments) {
      low = std::min(low, between_points(points, t));
      high = std::max(high, between_points(points, t));
    }
    EXPECT_GT(front, low - 0.12) << "at T = " << t;
    EXPECT_LT(front, high + 0.12) << "at T = " << t;
  }
}

/// The solver's density error over a collapse: average and largest, after every step.
TEST(SphStep, TheIncompressibleFluidIsNotCompressed) {
  constexpr double width = 0.1;
  SphProblem problem = sph_dam_break(2, width, 16);
  problem.parameters.method = SphMethod::divergence_free;
  problem.parameters.max_step = 2e-3;
  problem.parameters.courant = 0.25;
  problem.parameters.max_iterations = 25;
  gpu::SphStep step(test_context(), problem);
  double average = 0, largest = 0, samples = 0;
  for (int k = 1; k <= 60; ++k) {
    test_context().run([&](gpu::Commands& commands) { step.record(commands, 1e9); });
    if (k < 2) continue;
    const SphDensityError error = density_error(problem.parameters, step.densities().read());
    average += error.average;
    largest = std::max(largest, error.largest);
    samples += 1;
  }
  EXPECT_LT(average / samples, 1e-3);
  EXPECT_LT(largest, 1e-2);
  EXPECT_GT(measure(problem.parameters, step.read()).high.x, 1.2 * width);
}

/// The divergence solve stops where a step would add no more compression than the tolerance: rates
/// of density inside a fluid that collides with itself, seen by exact pairs.
TEST(SphPressure, NothingInsideIsBeingCompressedAfterTheDivergenceSolve) {
  SphProblem problem =
      sph_test::stirred_tank(2, 8, SphKernel::cubic_spline, 2, SphEquationOfState::tait, 11);
  SphParameters& p = problem.parameters;
  p.fixed_step = 0.2 * p.spacing / p.sound_speed;
  p.method = SphMethod::divergence_free;
  p.density_error = 1e-5;
  p.max_iterations = 2000;
  gpu::SphStep step(test_context(), problem);
  test_context().run([&](gpu::Commands& commands) { step.record(commands, 1e9); });
  const gpu::SphReport report = step.report();
  EXPECT_GT(report.divergence_iterations, 5u);
  EXPECT_LT(report.divergence_iterations, p.max_iterations);
  EXPECT_LT(report.iterations, p.max_iterations);
}

/// Gradients of a linear field are exact on disordered particles, at surfaces too; plain kernel
/// sums are not.
TEST(SphGradient, IsExactForLinearFields) {
  for (const std::uint32_t d : {2u, 3u}) {
    SphProblem problem =
        sph_test::stirred_tank(d, 7, SphKernel::wendland, 2.4, SphEquationOfState::tait, 3);
    const dmat3 slope =
        d == 3 ? dmat3(1, 2, 3, -4, 5, -6, 7, -8, 9) : dmat3(1, 2, 0, -4, 5, 0, 0, 0, 0);
    for (std::size_t i = 0; i < problem.initial.velocities.size(); ++i)
      problem.initial.velocities[i] =
          vec3(dvec3(0.5) + slope * dvec3(problem.initial.positions[i]));
    if (d == 2)
      for (vec3& v : problem.initial.velocities) v.z = 0;
    const SphNeighbourLists lists = cpu::sph_neighbours(problem);
    const std::vector<double> densities = cpu::sph_densities(problem, lists);
    const std::vector<dmat3> exact = cpu::sph_velocity_gradients(problem, lists, densities);
    const std::vector<mat3> device = gpu::sph_velocity_gradients(test_context(), problem);
    for (std::size_t i = 0; i < exact.size(); ++i)
      for (int k = 0; k < int(d); ++k) {
        // Velocities are floats: 2 u of 10 over a quarter spacing, times the fit's factor of 20.
        EXPECT_LT(glm::length(exact[i][k] - slope[k]), 20 * 2 * u * 10 / (0.25 * 0.07)) << i;
        EXPECT_LT(glm::length(dvec3(device[i][k]) - slope[k]), 20 * 60 * u * 10 / (0.25 * 0.07));
      }
  }
}

/// Pressures stay >= 0, and where one is above 0 the particle ends at its rest density: the
/// conditions of the projection.
TEST(SphPressure, SolvesTheComplementarityProblem) {
  SphProblem problem =
      sph_test::stirred_tank(2, 8, SphKernel::cubic_spline, 2, SphEquationOfState::tait, 11);
  SphParameters& p = problem.parameters;
  p.method = SphMethod::constant_density;
  p.fixed_step = p.spacing / p.sound_speed;
  p.density_error = 1e-7;
  p.max_iterations = 4000;
  const cpu::SphPressed few = cpu::sph_incompressible_velocities(problem);
  p.max_iterations = 8000;
  const cpu::SphPressed many = cpu::sph_incompressible_velocities(problem);
  double apart = 0, speed = 0;
  for (std::size_t i = 0; i < few.velocities.size(); ++i) {
    apart = std::max(apart, glm::length(few.velocities[i] - many.velocities[i]));
    speed = std::max(speed, glm::length(many.velocities[i]));
    EXPECT_GE(few.pressures[i], 0);
  }
  EXPECT_LT(apart, 1e-3 * speed);
}

/// A chart runs a hundred scenes.
TEST(SphStep, TheAdaptiveStepStaysStableInRandomScenes) {
  SphProblem problem = sph_random_scene(3);
  problem.duration /= 3;
  const double bound = sph_test::energy_bound(problem.parameters.courant);
  EXPECT_LT(sph_test::energy_over_finer(test_context(), problem), bound);
  problem.parameters.fixed_step = 3 * cpu::sph_stable_step(problem.parameters);
  EXPECT_GT(sph_test::energy_over_finer(test_context(), problem), bound);
}

/// A fixed step is stable up to the border of the lattice's own waves and friction. At rest the
/// walls and the pressure that holds the box move it a little.
TEST(SphStep, StabilityEndsWhereTheLatticePutsIt) {
  for (const double viscosity : {0.05, 1.0}) {
    SphProblem problem = sph_test::closed_box(10, 10, viscosity);
    const double stable = cpu::sph_stable_step(problem.parameters);
    problem.parameters.fixed_step = 0.9 * stable;
    EXPECT_LT(sph_test::speed_growth(test_context(), problem, 200), 10) << viscosity;
    problem.parameters.fixed_step = 1.1 * stable;
    EXPECT_GT(sph_test::speed_growth(test_context(), problem, 200), 10) << viscosity;
  }
}

/// Layers of a column carry the weight above them, to that of half a spacing; a chart has it finer.
TEST(SphStep, AColumnAtRestHasHydrostaticPressure) {
  SphProblem problem = sph_hydrostatic_column(2, 0.25, 1, 12);
  problem.parameters.artificial_viscosity = 4;
  problem.parameters.courant = 0.9;
  const sph_test::Column column = sph_test::settle_column(test_context(), problem);
  EXPECT_LT(column.error, 0.5 / 12);
}

}  // namespace
}  // namespace parity
