#include <algorithm>
#include <cmath>

#include "cpu_reference/numerics/conjugate_gradient.h"
#include "cpu_reference/numerics/multigrid.h"
#include "cpu_reference/numerics/relaxation.h"
#include "gpu/numerics/conjugate_gradient.h"
#include "gpu/numerics/multigrid.h"
#include "gpu/numerics/relaxation.h"
#include "tests/numerics/pressure_fields.h"
#include "tests/stage.h"

namespace parity {
namespace {

PressureProblem problem_of(const Setting& setting) {
  const int side = setting.count("side");
  const bool flat = setting.count("dimensions") == 2;
  const auto kind = PressureCase(setting.count("kind"));
  // Sides that are no multiples of each other; even along the axis that may be periodic.
  const ivec3 cells(2 * (side / 2), side + side / 3, flat ? 1 : std::max(side - 3, 2));
  return make_pressure_problem(cells, kind, setting.at("tolerance"), setting.seed);
}

/// Largest residual of an answer, of the largest right side: what every solver promises.
double relative_residual(const PressureProblem& problem, const PressureAnswer& answer) {
  return largest_magnitude(pressure_residual(problem, answer.pressure)) /
         largest_magnitude(problem.rhs);
}

/// The residual of the difference: A (p - q), of the largest right side. The constant that is free
/// in a closed box drops out.
double distance(const PressureProblem& problem, const PressureAnswer& got,
                const PressureAnswer& want) {
  const Field a = pressure_residual(problem, got.pressure);
  const Field b = pressure_residual(problem, want.pressure);
  double largest = 0;
  for (std::size_t i = 0; i < a.values.size(); ++i)
    largest = std::max(largest, std::abs(a.values[i] - b.values[i]));
  return largest / largest_magnitude(problem.rhs);
}

/// The tolerance of both sides, and what float leaves: pressures of up to P round by 2^-24 P in
/// each of the 13 operations of an equation.
double tolerance(const PressureProblem& problem) {
  PressureProblem loose = problem;
  loose.tolerance = 1e-3 * largest_magnitude(problem.rhs);
  const double pressure = largest_magnitude(
      cpu::conjugate_gradient(loose, cpu::Preconditioner::incomplete_cholesky).pressure);
  const double scale = largest_magnitude(problem.rhs);
  return 2 * problem.tolerance / scale + 13 * 0x1p-24 * 12 * pressure / scale;
}

using Cpu = CpuMethod<PressureProblem, PressureAnswer>;
using Gpu = GpuMethod<PressureProblem, PressureAnswer>;

/// Plain sweeps take as many as the square of the longest side.
PressureProblem for_sweeps(PressureProblem p) {
  if (std::max({p.cells.x, p.cells.y, p.cells.z}) > 20)
    throw Unsupported("sweeps are compared up to 20 cells along an axis");
  p.max_iterations = 20000;
  return p;
}

/// Coarse grids cannot follow a free surface; there the cycle belongs inside conjugate gradients.
const PressureProblem& for_cycles(const PressureProblem& p) {
  if (std::ranges::count(p.types, CellType::air) > 0)
    throw Unsupported("multigrid alone is not for free surfaces");
  return p;
}

double best_omega(const PressureProblem& p) {
  return 2 / (1 + std::sin(3.14159265 / std::max({p.cells.x, p.cells.y, p.cells.z})));
}

const Registration registration = register_stage<PressureProblem, PressureAnswer>(
    {.name = "numerics/pressure",
     .title = "Pressure of an incompressible fluid: sweeps, conjugate gradients, multigrid",
     .source = "notes 9.3, 10.4; Bridson 2015; McAdams, Sifakis & Teran 2010",
     .rows = {147, 148, 149, 167},
     .axes =
         {{.name = "side", .low = 2, .high = 40, .standard = 11, .whole = true},
          {.name = "dimensions", .low = 2, .high = 3, .standard = 3, .whole = true},
          {.name = "kind", .low = 0, .high = 4, .standard = 2, .whole = true, .each = true},
          {.name = "tolerance", .low = 1e-5, .high = 1e-2, .standard = 1e-4, .logarithmic = true}},
     .problem = problem_of,
     .cpu =
         {Cpu{.name = "pcg_incomplete_cholesky",
              .solve =
                  [](const PressureProblem& p) {
                    return cpu::conjugate_gradient(p, cpu::Preconditioner::incomplete_cholesky);
                  }},
          Cpu{.name = "cg",
              .solve =
                  [](const PressureProblem& p) {
                    return cpu::conjugate_gradient(p, cpu::Preconditioner::none);
                  },
              .must_agree = true},
          Cpu{.name = "jacobi",
              .solve = [](const PressureProblem& p) { return cpu::jacobi(for_sweeps(p), 0.9); },
              .must_agree = true},
          Cpu{.name = "gauss_seidel",
              .solve = [](const PressureProblem& p) { return cpu::gauss_seidel(for_sweeps(p), 1); },
              .must_agree = true},
          Cpu{.name = "sor",
              .solve = [](const PressureProblem& p) { return cpu::gauss_seidel(p, best_omega(p)); },
              .must_agree = true},
          Cpu{.name = "multigrid",
              .solve = [](const PressureProblem& p) { return cpu::multigrid(p); },
              .must_agree = true}},
     .gpu = {Gpu{.name = "multigrid_cg",
                 .solve =
                     [](gpu::Context& context, const PressureProblem& p) {
                       return gpu::conjugate_gradient(context, p, gpu::Preconditioner::multigrid);
                     }},
             Gpu{.name = "multigrid",
                 .solve =
                     [](gpu::Context& context, const PressureProblem& p) {
                       return gpu::multigrid(context, for_cycles(p), false);
                     }},
             Gpu{.name = "full_multigrid",
                 .solve =
                     [](gpu::Context& context, const PressureProblem& p) {
                       return gpu::multigrid(context, for_cycles(p), true);
                     }},
             Gpu{.name = "cg",
                 .solve =
                     [](gpu::Context& context, const PressureProblem& p) {
                       return gpu::conjugate_gradient(context, p, gpu::Preconditioner::none);
                     }},
             Gpu{.name = "jacobi",
                 .solve =
                     [](gpu::Context& context, const PressureProblem& p) {
                       return gpu::relaxation(context, for_sweeps(p), gpu::RelaxationMethod::jacobi,
                                              0.9);
                     }},
             Gpu{.name = "gauss_seidel",
                 .solve =
                     [](gpu::Context& context, const PressureProblem& p) {
                       return gpu::relaxation(context, for_sweeps(p),
                                              gpu::RelaxationMethod::gauss_seidel, 1);
                     }},
             Gpu{.name = "sor",
                 .solve =
                     [](gpu::Context& context, const PressureProblem& p) {
                       return gpu::relaxation(context, p, gpu::RelaxationMethod::sor,
                                              best_omega(p));
                     }}},
     .distance = distance,
     .tolerance = tolerance,
     .why = "A (p - q) is the difference of two residuals, each within the tolerance asked for; "
            "float pressures of size P round by 2^-24 P in the 13 operations of an equation, whose "
            "coefficients sum to at most 12",
     .error = relative_residual,
     .error_unit = "largest rhs",
     .chart_axes = {"tolerance"}});

}  // namespace
}  // namespace parity
