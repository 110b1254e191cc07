#include "cpu_reference/sph/gradient.h"

#include "cpu_reference/sph/kernel.h"

namespace parity::cpu {
namespace {

/// The normal equations of a fit v(x) = v_i + G (x - x_i).
struct Fit {
  dmat3 moments{0};  ///< sum of weight offset offset^T
  dmat3 changes{0};  ///< sum of weight change offset^T
};

void add(Fit& fit, double weight, const dvec3& offset, const dvec3& change) {
  fit.moments += weight * glm::outerProduct(offset, offset);
  fit.changes += weight * glm::outerProduct(change, offset);
}

dmat3 solved(const Fit& fit, std::uint32_t dimensions) {
  dmat3 moments = fit.moments;
  if (dimensions == 2) moments[2][2] = (moments[0][0] + moments[1][1]) / 2;
  const double mean = (moments[0][0] + moments[1][1] + moments[2][2]) / 3;
  if (!(mean > 0 && glm::determinant(moments) >= 0.05 * mean * mean * mean)) return dmat3(0);
  return fit.changes * glm::inverse(moments);
}

}  // namespace

std::vector<dmat3> sph_velocity_gradients(const SphProblem& problem,
                                          const SphNeighbourLists& neighbours,
                                          const std::vector<double>& densities) {
  const SphParameters& p = problem.parameters;
  const SphState& state = problem.initial;
  std::vector<dmat3> gradients;
  for (std::size_t i = 0; i < state.positions.size(); ++i) {
    Fit fit;
    for (const std::uint32_t j : neighbours.fluid[i]) {
      const dvec3 offset = dvec3(state.positions[j]) - dvec3(state.positions[i]);
      const double r = glm::length(offset);
      if (r == 0) continue;
      const double slope = sph_kernel_derivative(p.kernel, p.dimensions, r, p.support);
      add(fit, -slope / r * particle_mass(p) / densities[j], offset,
          dvec3(state.velocities[j]) - dvec3(state.velocities[i]));
    }
    gradients.push_back(solved(fit, p.dimensions));
  }
  return gradients;
}

}  // namespace parity::cpu
