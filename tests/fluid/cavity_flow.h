#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "cpu_reference/fluid/advect.h"
#include "gpu/fluid/step.h"

/// The lid-driven cavity, run to where it is steady, and profiles of it.
namespace parity {

/// The value at `at` of the cubic through the four points nearest to it; x ascends.
inline double cubic_through(const std::vector<double>& x, const std::vector<double>& y, double at) {
  const auto above = std::ranges::upper_bound(x, at) - x.begin();
  const auto first = std::size_t(std::clamp<std::ptrdiff_t>(above - 2, 0, std::ssize(x) - 4));
  double value = 0;
  for (std::size_t i = first; i < first + 4; ++i) {
    double weight = 1;
    for (std::size_t j = first; j < first + 4; ++j)
      if (j != i) weight *= (at - x[j]) / (x[i] - x[j]);
    value += weight * y[i];
  }
  return value;
}

/// A field along an axis through a place, from its points and the values at both walls.
inline double along(const Field& u, int axis, ivec3 place, double at, double low, double high) {
  std::vector<double> x{0}, y{low};
  const double h = 1.0 / u.size[axis];
  for (int k = 0; k < u.size[axis]; ++k) {
    place[axis] = k;
    x.push_back((k + 0.5) * h);
    y.push_back(u(place));
  }
  x.push_back(1);
  y.push_back(high);
  return cubic_through(x, y, at);
}

/// Speed across the vertical centreline, and across the horizontal one.
inline double centre_u(const FluidState& state, double y) {
  const Field& u = state.velocity[0];
  return along(u, 1, {(u.size.x - 1) / 2, 0, 0}, y, 0, 1);
}
inline double centre_v(const FluidState& state, double x) {
  const Field& v = state.velocity[1];
  return along(v, 0, {0, (v.size.y - 1) / 2, 0}, x, 0, 0);
}

/// One grid's flow.
struct CavityRun {
  FluidDomain domain;
  FluidState state;
  bool converged = true;  ///< every projection
};

/// Where the flow of `cells` a side begins: that of the finest run so far and, from two on, what
/// second order says is still missing.
inline void begin_with(FluidProblem& problem, const std::vector<CavityRun>& runs) {
  const int cells = problem.domain.cells.x;
  const auto at = [&](const CavityRun& run, int axis, ivec3 face) {
    return cpu::sample(run.domain, run.state.velocity[std::size_t(axis)], axis,
                       point_position(problem.domain, axis, face));
  };
  for (int axis = 0; axis < 2 && !runs.empty(); ++axis) {
    Field& u = problem.initial.velocity[std::size_t(axis)];
    for (int y = 0; y < u.size.y; ++y)
      for (int x = 0; x < u.size.x; ++x) {
        if ((axis == 0 ? x : y) == 0 || (axis == 0 ? x : y) == cells) continue;
        const double fine = at(runs.back(), axis, {x, y, 0});
        u(x, y, 0) = fine;
        if (runs.size() < 2) continue;
        const CavityRun& coarse = runs[runs.size() - 2];
        const auto square = [](int n) { return 1.0 / (double(n) * n); };
        const int n0 = coarse.domain.cells.x, n1 = runs.back().domain.cells.x;
        u(x, y, 0) += (square(n1) - square(cells)) / (square(n0) - square(n1)) *
                      (fine - at(coarse, axis, {x, y, 0}));
      }
  }
}

/// From coarse to fine: pairs of cells a side and seconds to run.
inline std::vector<CavityRun> cavity_runs(gpu::Context& context, double reynolds,
                                          const std::vector<std::pair<int, double>>& grids) {
  std::vector<CavityRun> runs;
  for (const auto& [cells, time] : grids) {
    FluidProblem problem = lid_driven_cavity(cells, reynolds);
    problem.parameters.divergence = 1e-2;
    begin_with(problem, runs);
    gpu::FluidSimulation simulation(context, problem);
    const FluidClock clock = simulation.run_until(time, 32);
    runs.push_back({problem.domain, simulation.read(), clock.unconverged == 0});
  }
  return runs;
}

}  // namespace parity
