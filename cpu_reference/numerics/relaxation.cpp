#include "cpu_reference/numerics/relaxation.h"

#include "cpu_reference/numerics/pressure_matrix.h"

namespace parity::cpu {
namespace {

/// Calls sweep(x) until the residual is small enough.
template <typename Sweep>
PressureAnswer iterate(const PressureProblem& problem, const Sweep& sweep) {
  const PressureMatrix a(problem);
  const std::vector<double> b = a.gather(problem.rhs);
  std::vector<double> x = a.gather(problem.guess);
  PressureAnswer answer;
  for (;;) {
    answer.residual = largest(a.residual(x, b));
    answer.converged = answer.residual <= problem.tolerance;
    if (answer.converged || answer.iterations >= problem.max_iterations) break;
    sweep(a, b, x);
    ++answer.iterations;
  }
  answer.pressure = a.scatter(x);
  return answer;
}

}  // namespace

PressureAnswer jacobi(const PressureProblem& problem, double omega) {
  return iterate(problem, [omega](const PressureMatrix& a, const std::vector<double>& b,
                                  std::vector<double>& x) {
    const std::vector<double> residual = a.residual(x, b);
    for (std::size_t i = 0; i < x.size(); ++i)
      if (a.diagonal[i] > 0) x[i] += omega * residual[i] / a.diagonal[i];
  });
}

PressureAnswer gauss_seidel(const PressureProblem& problem, double omega) {
  return iterate(problem, [omega](const PressureMatrix& a, const std::vector<double>& b,
                                  std::vector<double>& x) {
    for (std::size_t i = 0; i < x.size(); ++i)
      if (a.diagonal[i] > 0) x[i] += omega * ((b[i] + a.neighbours(i, x)) / a.diagonal[i] - x[i]);
  });
}

}  // namespace parity::cpu
