#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "cpu_reference/fluid/liquid.h"
#include "cpu_reference/fluid/step.h"
#include "gpu/fluid/step.h"
#include "tests/fluid/cavity_flow.h"
#include "tests/fluid/fluid_fields.h"
#include "tests/fluid/random_scenes.h"
#include "tests/gpu_context.h"
#include "tests/shared_data.h"

/// Fluids on a grid against closed forms and published tables.
namespace parity {
namespace {

FluidState run_to(const FluidProblem& problem, double time) {
  gpu::FluidSimulation simulation(test_context(), problem);
  const FluidClock clock = simulation.run_until(time, 32);
  EXPECT_EQ(clock.unconverged, 0u);
  EXPECT_NEAR(double(clock.time), time, 1e-5 * time);
  return simulation.read();
}

/// Rows "position, Re 100, Re 400, Re 1000" of a table of Ghia, Ghia & Shin.
std::vector<std::array<double, 4>> ghia_table(const std::string& path) {
  std::vector<std::array<double, 4>> rows;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    std::array<double, 4> row{};
    char comma = 0;
    std::istringstream words(line);
    if (words >> row[0] >> comma >> row[1] >> comma >> row[2] >> comma >> row[3])
      rows.push_back(row);
  }
  return rows;
}

struct GhiaCase {
  double reynolds;
  std::size_t column;
  std::vector<std::pair<int, double>> grids;
};

/// Of v at Re 400: -0.23827 stands in the published table and in each of the public copies of it
/// that were compared, so it is no slip of a copy. The rows around it contradict it (the test
/// below), and so does the flow, by more than a tenth of the lid's speed where all other rows fit.
constexpr double misprint = 0.9063;

class Ghia : public testing::TestWithParam<GhiaCase> {};

TEST_P(Ghia, CavityCentrelinesWithinOnePercentOfTheLid) {
  const auto u_path = shared_data("reference/ghia1982_u_vertical_centreline.csv");
  const auto v_path = shared_data("reference/ghia1982_v_horizontal_centreline.csv");
  if (!u_path || !v_path) GTEST_SKIP() << "skipped: no shared data";
  const GhiaCase& c = GetParam();
  const CavityRun run = cavity_runs(test_context(), c.reynolds, c.grids).back();
  EXPECT_TRUE(run.converged);
  const FluidState& state = run.state;
  const auto u_rows = ghia_table(u_path->string()), v_rows = ghia_table(v_path->string());
  ASSERT_EQ(u_rows.size(), 17u);
  ASSERT_EQ(v_rows.size(), 17u);
  for (const auto& row : u_rows)
    EXPECT_NEAR(centre_u(state, row[0]), row[c.column], 0.01) << "u at y = " << row[0];
  for (const auto& row : v_rows) {
    if (c.reynolds == 400 && row[0] == misprint) {
      EXPECT_LT(centre_v(state, row[0]), row[c.column] - 0.1);
      continue;
    }
    EXPECT_NEAR(centre_v(state, row[0]), row[c.column], 0.01) << "v at x = " << row[0];
  }
}

/// A cubic through the rows around meets the row at Re 100 and at Re 1000, where the profile bends
/// most there, within 1 % of the lid's speed, and misses it by 13 % at Re 400.
TEST(GhiaTable, TheRowThatIsLeftOutContradictsThoseAroundIt) {
  const auto path = shared_data("reference/ghia1982_v_horizontal_centreline.csv");
  if (!path) GTEST_SKIP() << "skipped: no shared data";
  for (const std::size_t column : {1u, 2u, 3u}) {
    std::vector<double> x, y;
    double printed = 0;
    for (const auto& row : ghia_table(path->string())) {
      if (row[0] == misprint) {
        printed = row[column];
        continue;
      }
      x.insert(x.begin(), row[0]);
      y.insert(y.begin(), row[column]);
    }
    const double apart = std::abs(cubic_through(x, y, misprint) - printed);
    const bool is_contradicted = apart > 0.13;
    EXPECT_EQ(is_contradicted, column == 2) << apart;
    EXPECT_TRUE(is_contradicted || apart < 0.01) << apart;
  }
}

// Steady once the remaining change is far below 1 %: most of the way is made on the coarse grid.
INSTANTIATE_TEST_SUITE_P(Cavity, Ghia,
                         testing::Values(GhiaCase{100, 1, {{24, 8}, {64, 1.5}}},
                                         GhiaCase{400, 2, {{24, 16}, {48, 10}, {80, 6}}}),
                         [](const auto& test) {
                           return "Re" + std::to_string(int(test.param.reynolds));
                         });

double taylor_green_error(int cells, int dimensions, double viscosity, double time) {
  FluidProblem problem = taylor_green(cells, viscosity, dimensions);
  problem.parameters.divergence = 1e-4;
  const FluidState state = run_to(problem, time);
  const FaceFields exact = taylor_green_velocity(problem.domain, viscosity, time);
  double error = 0;
  for (std::size_t axis = 0; axis < 2; ++axis)
    for (std::size_t i = 0; i < exact[axis].values.size(); ++i)
      error = std::max(error, std::abs(exact[axis].values[i] - state.velocity[axis].values[i]));
  return error;
}

TEST(TaylorGreen, DecaysWithOrderTwoInSpaceAndTime) {
  const double coarse = taylor_green_error(16, 2, 0.1, 1), fine = taylor_green_error(32, 2, 0.1, 1);
  EXPECT_GE(std::log2(coarse / fine), 1.9);
  EXPECT_LT(fine, 1e-3);
}

TEST(TaylorGreen, IsTheSameInThreeDimensions) {
  const double flat = taylor_green_error(8, 2, 0.1, 0.5);
  EXPECT_NEAR(taylor_green_error(8, 3, 0.1, 0.5), flat, 0.05 * flat);
}

/// Speeds of a channel at the middles of its cells.
std::vector<double> profile(const FluidState& state) {
  std::vector<double> speeds;
  for (int y = 0; y < state.velocity[0].size.y; ++y) speeds.push_back(state.velocity[0](1, y, 0));
  return speeds;
}

TEST(Couette, StartsAsTheFourierSeriesSays) {
  const int cells = 24;
  const double viscosity = 0.1;
  const FluidProblem problem = couette_start(cells, viscosity);
  gpu::FluidSimulation simulation(test_context(), problem);
  for (const double time : {0.5, 1.0}) {  // viscosity time / height^2: 0.05, 0.1
    simulation.run_until(time, 32);
    const std::vector<double> speeds = profile(simulation.read());
    // Second order: the error is that of the boundary layer, h^2 / (viscosity time) of the speed.
    for (int y = 0; y < cells; ++y)
      EXPECT_NEAR(speeds[std::size_t(y)], couette_speed(viscosity, time, (y + 0.5) / cells),
                  1.0 / (cells * cells) / (viscosity * time) / 12);
  }
}

TEST(Couette, TheSeriesIsThatOfTheTable) {
  EXPECT_NEAR(couette_speed(1, 0.05, 0.5), 0.1138441966, 1e-9);
  EXPECT_NEAR(couette_speed(1, 0.01, 0.9), 0.4795001222, 1e-9);
}

TEST(Poiseuille, ThePushedChannelIsAParabola) {
  const int cells = 16;
  const std::vector<double> speeds = profile(run_to(poiseuille(cells, 1), 0.75));
  // The scheme's own parabola lies h^2 of the exact one's curvature above it: (y (1 - y) +
  // h^2/4) 4.
  for (int y = 0; y < cells; ++y) {
    const double at = (y + 0.5) / cells;
    EXPECT_NEAR(speeds[std::size_t(y)], 4 * at * (1 - at),
                1.0 / (cells * cells) + 1.04 * std::exp(-0.75 * 9.87));
  }
}

TEST(Hydrostatic, StratifiedFluidAtRestStaysAtRest) {
  FluidProblem problem = hydrostatic_box(24, 2);
  problem.parameters.divergence = 1e-5;
  problem.parameters.max_iterations = 60;
  const FluidState state = run_to(problem, 0.5);
  // Relative to the speed of a fall from the column's height.
  EXPECT_LT(measure(problem, state).max_speed / std::sqrt(2 * 9.81), 1e-6);
  const double weight = 1000 * 9.81 / 24;
  for (int y = 1; y < 24; ++y)
    EXPECT_NEAR(state.pressure(3, y - 1, 0) - state.pressure(3, y, 0), weight, 1e-4 * weight);
}

TEST(FluidSimulation, TheAdaptiveStepStaysStableInRandomScenes) {
  // The chart fluid/random_scenes runs a hundred.
  for (const std::uint64_t seed : {1u, 2u, 3u, 5u, 8u, 13u})
    EXPECT_LE(speed_over_bound(test_context(), random_fluid(seed), 0.04), 1) << seed;
}

/// Fronts of a series of Martin & Moyce: times and places.
std::vector<dvec2> fronts(const std::string& path, const std::string& series) {
  std::vector<dvec2> points;
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with(series)) continue;
    char comma = 0;
    dvec2 point;
    std::istringstream words(line.substr(series.size()));
    if (words >> comma >> point.x >> comma >> point.y) points.push_back(point);
  }
  return points;
}

/// When the front passes the place z, T = t sqrt(2 g / a).
double passing_time(const std::vector<dvec2>& path, double z) {
  for (std::size_t i = 1; i < path.size(); ++i)
    if (path[i].y >= z)
      return path[i - 1].x +
             (z - path[i - 1].y) / (path[i].y - path[i - 1].y) * (path[i].x - path[i - 1].x);
  return path.back().x;
}

/// The largest time between points and a path at places that it passes too.
double time_apart(const std::vector<dvec2>& points, const std::vector<dvec2>& path) {
  double largest = 0;
  for (const dvec2 point : points)
    if (point.y >= path.front().y && point.y <= path.back().y)
      largest = std::max(largest, std::abs(point.x - passing_time(path, point.y)));
  return largest;
}

/// The experiment's clock starts with a membrane that takes time to give way; no simulation has
/// one. So time counts from the first recorded place on, on both sides, and nothing is fitted. For
/// as long as the tail of the column falls freely, Z < 3.8, the front must pass all further places
/// when either series does: as near as the two are to each other, which is 0.11 units, and as the
/// digitising is good for, which is 0.02.
TEST(DamBreak, TheFrontIsThatOfMartinAndMoyce) {
  const auto path = shared_data("reference/dam_break_front.csv");
  if (!path) GTEST_SKIP() << "skipped: no shared data";
  const double width = 0.05715, unit = std::sqrt(2 * 9.81 / width);
  FluidProblem problem = dam_break(20, width, 2);
  problem.parameters.divergence = 0.1;
  gpu::FluidSimulation simulation(test_context(), problem);
  std::vector<dvec2> front{{0, 1}};
  for (double time = 0.4; time < 3.05; time += 0.2) {
    EXPECT_EQ(simulation.run_until(time / unit, 4).unconverged, 0u);
    front.push_back({time, measure(problem, simulation.read()).front / width});
  }
  const auto small = fronts(path->string(), "martin_moyce_1952_a1.125in");
  const auto large = fronts(path->string(), "martin_moyce_1952_a2.25in");
  const auto early = [](std::vector<dvec2> points) {
    std::erase_if(points, [](dvec2 point) { return point.y >= 3.8; });
    return points;
  };
  const double apart = std::max(time_apart(early(small), large), time_apart(early(large), small));
  EXPECT_NEAR(apart, 0.11, 0.005);
  for (const std::vector<dvec2>& points : {early(small), early(large)}) {
    ASSERT_GE(points.size(), 4u);
    const dvec2 first = points.front();
    const double delay = first.x - passing_time(front, first.y);
    EXPECT_GT(delay, 0);  // a membrane holds back
    EXPECT_LT(delay, 0.35);
    for (const dvec2 point : points)
      EXPECT_NEAR(passing_time(front, point.y) + delay, point.x, apart + 0.02) << "Z " << point.y;
  }
}

/// A drop of random particle velocities, without walls near; nothing but gravity pushes it.
FluidProblem falling_drop(FluidMethod method) {
  FluidProblem problem = dam_break(8, 1, 2);
  problem.initial.particles = {};
  add_liquid(problem, {1.5, 1.2, 0}, {2.5, 2.2, 1});
  problem.parameters.method = method;
  for (vec3& v : problem.initial.particles.velocities) v = {0.25f, 0.5f, 0};
  return problem;
}

TEST(Liquid, AFallingBlockKeepsMassAndGainsTheMomentumOfGravity) {
  for (const FluidMethod method : {FluidMethod::flip, FluidMethod::apic}) {
    const FluidProblem problem = falling_drop(method);
    const FluidMeasures before = measure(problem, problem.initial);
    FluidState state = problem.initial;
    const double step = 1.0 / 64;
    for (int k = 0; k < 8; ++k) state = gpu::step(test_context(), problem, state, step);
    const FluidMeasures after = measure(problem, state);
    EXPECT_EQ(after.mass, before.mass);
    // Momenta of 1e3 kg m/s; each step rounds velocities of 1 m/s in a dozen operations.
    const double rounding = 8 * 12 * 0x1p-24 * before.mass;
    EXPECT_NEAR(after.momentum.x, before.momentum.x, rounding);
    EXPECT_NEAR(after.momentum.y, before.momentum.y - before.mass * 9.81 * 8 * step, rounding * 3);
  }
}

TEST(Liquid, BothTransfersKeepMomentumToRounding) {
  FluidProblem problem = dam_break(8, 1, 2);
  Random random(5, 1);
  for (vec3& v : problem.initial.particles.velocities)
    v = {random.uniform(-1, 1), random.uniform(-1, 1), 0};
  const cpu::FaceTransfer transfer = cpu::particles_to_faces(problem, problem.initial.particles);
  for (std::size_t axis = 0; axis < 2; ++axis) {
    double faces = 0, particles = 0;
    for (std::size_t i = 0; i < transfer.weight[axis].values.size(); ++i)
      faces += transfer.weight[axis].values[i] * transfer.velocity[axis].values[i];
    for (const vec3 v : problem.initial.particles.velocities) particles += double(v[int(axis)]);
    EXPECT_NEAR(faces, particles, 1e-12 * double(problem.initial.particles.count()));
  }
}

TEST(Liquid, AColumnAtRestStaysAtRest) {
  FluidProblem problem = hydrostatic_liquid(8, 2);
  problem.parameters.divergence = 1e-5;
  problem.parameters.max_iterations = 60;
  gpu::FluidSimulation simulation(test_context(), problem);
  EXPECT_EQ(simulation.run_until(0.2, 8).unconverged, 0u);
  const FluidMeasures m = measure(problem, simulation.read());
  double fastest = 0;
  for (const vec3 v : simulation.read().particles.velocities)
    fastest = std::max(fastest, double(glm::length(v)));
  EXPECT_LT(fastest / std::sqrt(2 * 9.81), 1e-6);
  EXPECT_EQ(m.mass, measure(problem, problem.initial).mass);
}

TEST(FluidSimulation, TheSizeOfBatchesDoesNotMatter) {
  for (const FluidMethod method :
       {FluidMethod::maccormack, FluidMethod::central, FluidMethod::flip}) {
    FluidProblem problem = is_liquid(method) ? dam_break(8, 1, 2) : smoke_plume(12, 2);
    problem.parameters.method = method;
    problem.parameters.sparse = method == FluidMethod::maccormack;
    gpu::FluidSimulation single(test_context(), problem), batched(test_context(), problem);
    // The end falls into a batch: steps after it do nothing.
    EXPECT_EQ(single.run_until(0.12, 1).steps, batched.run_until(0.12, 8).steps);
    EXPECT_EQ(numbers_of(single.read()), numbers_of(batched.read())) << int(method);
    single.run_until(0.2, 1);
    batched.run_until(0.2, 8);
    EXPECT_EQ(numbers_of(single.read()), numbers_of(batched.read())) << int(method);
  }
}

TEST(FluidSimulation, AResumedRunHasTheSameBits) {
  for (const FluidMethod method :
       {FluidMethod::maccormack, FluidMethod::central, FluidMethod::flip}) {
    FluidProblem problem = is_liquid(method) ? dam_break(8, 1, 2) : smoke_plume(12, 2);
    problem.parameters.method = method;
    problem.parameters.fixed_step = 1.0 / 64;
    gpu::FluidSimulation whole(test_context(), problem), first(test_context(), problem),
        second(test_context(), problem);
    whole.run_until(8.0 / 64, 4);
    first.run_until(4.0 / 64, 4);
    second.write(first.read());
    second.run_until(8.0 / 64, 4);
    EXPECT_EQ(numbers_of(whole.read()), numbers_of(second.read())) << int(method);
  }
}

TEST(FluidSimulation, MemoryIsAsStated) {
  // Per cell of a box of smoke: 9 face values, 6 scalars, pressure and right side with a seventh
  // for the coarse grids: 17.3 floats; spin and vorticity 8. What does not grow is below 100 kB.
  FluidProblem problem = smoke_plume(24, 3);
  problem.solids.clear();
  gpu::FluidSimulation simulation(test_context(), problem);
  const double cells = double(problem.domain.cell_count());
  EXPECT_LT(double(simulation.memory_bytes()), cells * 4 * 26 * 1.15 + 1e5);
}

/// The reference alone: small grids, the same formulas.
TEST(CpuFluid, TaylorGreenHasOrderTwo) {
  const auto error = [](int cells) {
    FluidProblem problem = taylor_green(cells, 0.1, 2);
    problem.parameters.divergence = 1e-8;
    const int steps = cells;
    const FluidState state = cpu::run(problem, problem.initial, 0.5 / steps, steps);
    const FaceFields exact = taylor_green_velocity(problem.domain, 0.1, 0.5);
    double worst = 0;
    for (std::size_t i = 0; i < exact[0].values.size(); ++i)
      worst = std::max(worst, std::abs(exact[0].values[i] - state.velocity[0].values[i]));
    return worst;
  };
  EXPECT_GE(std::log2(error(8) / error(16)), 1.9);
}

}  // namespace
}  // namespace parity
