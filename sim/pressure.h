#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sim/fluid.h"

/// The linear system of a pressure projection: for each fluid cell c with neighbours n across its
/// faces f,
///
///   sum over f of open_f (p_c - p_n) = rhs_c,
///
/// where the pressure of air and beyond open sides is 0. That is the negative Laplacian times the
/// square of the spacing: symmetric and positive (semi-)definite.
namespace parity {

struct PressureProblem {
  ivec3 cells{0};
  std::array<bool, 3> periodic{};
  std::vector<CellType> types;
  FaceFields open;          ///< multiples of 1 / open_steps
  Field rhs;                ///< Pa; 0 outside the fluid
  Field guess;              ///< Pa; where the iteration begins
  double tolerance = 1e-5;  ///< Pa, largest |rhs - A p| to stop at
  int max_iterations = 1000;
};

struct PressureAnswer {
  Field pressure;       ///< Pa; 0 outside the fluid. Without air or open sides: up to a constant
  int iterations = 0;   ///< sweeps, steps or cycles
  double residual = 0;  ///< largest |rhs - A p| that is left, by the solver's own measure
  bool converged = false;
};

/// Pressure from the divergence that velocities would keep: rhs = -density spacing^2 / step *
/// divergence. A residual r leaves the divergence r step / (density spacing^2).
PressureProblem pressure_problem(const FluidProblem& fluid, const FluidState& state, double step);

/// rhs - A p in fluid cells, 0 elsewhere.
Field pressure_residual(const PressureProblem& problem, const Field& pressure);
/// NaN if a value is.
double largest_magnitude(const Field& field);

/// Nothing fixes the constant: no fluid cell touches air or an open side.
bool is_singular(const PressureProblem& problem);

/// Takes the mean over fluid cells off a field.
void remove_mean(const PressureProblem& problem, Field& field);

/// What a test problem holds.
enum class PressureCase : std::uint32_t { box, open_top, sphere, periodic, liquid };

/// A smooth source and sink with random ripples on a box, open or closed, with a ball or half full
/// of liquid; solvable. `tolerance` is relative to the largest right side.
///
/// @throws std::invalid_argument  a side is below 1, or odd along x for `periodic`.
PressureProblem make_pressure_problem(ivec3 cells, PressureCase kind, double tolerance,
                                      std::uint64_t seed);

}  // namespace parity
