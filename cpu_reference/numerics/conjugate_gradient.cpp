#include "cpu_reference/numerics/conjugate_gradient.h"

#include <cmath>

#include "cpu_reference/numerics/pressure_matrix.h"

namespace parity::cpu {
namespace {

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

/// L with the pattern of A's lower triangle, stored as the inverse of its diagonal: the entry of
/// row i in column j is -a_ij times the inverse of column j.
class IncompleteCholesky {
 public:
  explicit IncompleteCholesky(const PressureMatrix& a) : a_(a), inverse_(a.size()) {
    constexpr double modification = 0.97, safety = 0.25;
    for (std::size_t i = 0; i < a.size(); ++i) {
      double pivot = a.diagonal[i];
      for_lower(i, [&](std::size_t j, double value) {
        const double l = value * inverse_[j];
        pivot -= l * l;
        for_upper(j, [&](std::size_t k, double other) {
          if (k != i) pivot -= modification * l * other * inverse_[j];
        });
      });
      if (pivot < safety * a.diagonal[i]) pivot = a.diagonal[i];
      inverse_[i] = pivot > 0 ? 1 / std::sqrt(pivot) : 0;
    }
  }

  std::vector<double> solve(const std::vector<double>& r) const {
    std::vector<double> x(r);
    for (std::size_t i = 0; i < x.size(); ++i) {
      for_lower(i, [&](std::size_t j, double value) { x[i] += value * inverse_[j] * x[j]; });
      x[i] *= inverse_[i];
    }
    for (std::size_t i = x.size(); i-- > 0;) {
      for_upper(i, [&](std::size_t j, double value) { x[i] += value * inverse_[i] * x[j]; });
      x[i] *= inverse_[i];
    }
    return x;
  }

 private:
  template <typename Visit>
  void for_lower(std::size_t i, const Visit& visit) const {
    for (std::size_t k = a_.begin[i]; k < a_.begin[i + 1]; ++k)
      if (a_.links[k].column < i) visit(a_.links[k].column, a_.links[k].value);
  }
  template <typename Visit>
  void for_upper(std::size_t i, const Visit& visit) const {
    for (std::size_t k = a_.begin[i]; k < a_.begin[i + 1]; ++k)
      if (a_.links[k].column > i) visit(a_.links[k].column, a_.links[k].value);
  }

  const PressureMatrix& a_;
  std::vector<double> inverse_;
};

std::vector<double> divide(const std::vector<double>& r, const std::vector<double>& diagonal) {
  std::vector<double> z(r.size());
  for (std::size_t i = 0; i < r.size(); ++i) z[i] = diagonal[i] > 0 ? r[i] / diagonal[i] : 0;
  return z;
}

}  // namespace

PressureAnswer conjugate_gradient(const PressureProblem& problem, Preconditioner preconditioner) {
  const PressureMatrix a(problem);
  const IncompleteCholesky factor(a);
  const auto precondition = [&](const std::vector<double>& r) {
    switch (preconditioner) {
      case Preconditioner::none:
        return r;
      case Preconditioner::jacobi:
        return divide(r, a.diagonal);
      default:
        return factor.solve(r);
    }
  };
  std::vector<double> x = a.gather(problem.guess);
  std::vector<double> r = a.residual(x, a.gather(problem.rhs));
  std::vector<double> direction(x.size(), 0.0);
  double last = 0;
  PressureAnswer answer;
  for (;;) {
    answer.residual = largest(r);
    answer.converged = answer.residual <= problem.tolerance;
    if (answer.converged || answer.iterations >= problem.max_iterations) break;
    const std::vector<double> z = precondition(r);
    const double now = dot(z, r);
    const double beta = last > 0 ? now / last : 0;
    last = now;
    for (std::size_t i = 0; i < x.size(); ++i) direction[i] = z[i] + beta * direction[i];
    const std::vector<double> image = a.times(direction);
    const double curvature = dot(direction, image);
    if (!(curvature > 0)) break;
    const double alpha = now / curvature;
    for (std::size_t i = 0; i < x.size(); ++i) {
      x[i] += alpha * direction[i];
      r[i] -= alpha * image[i];
    }
    ++answer.iterations;
  }
  answer.pressure = a.scatter(x);
  return answer;
}

}  // namespace parity::cpu
