#include "cpu_reference/sph/viscosity.h"

#include <cmath>

#include "cpu_reference/sph/density.h"
#include "cpu_reference/sph/kernel.h"

namespace parity::cpu {
namespace {

/// A dashpot between two particles, or between one and a wall: it pulls along `line`, a unit
/// vector, with `strength` times how fast they part.
struct Dashpot {
  std::uint32_t first, second;
  dvec3 line;
  double strength;  ///< 1/s, of the first; a wall feels nothing
};

struct Dashpots {
  std::vector<Dashpot> pairs;
  std::vector<Dashpot> walls;  ///< second: of the wall particle
};

dvec3 wall_velocity(const SphProblem& problem, std::uint32_t j) {
  return problem.boundary_motions.empty() ? dvec3(0) : dvec3(problem.boundary_motions[j]);
}

Dashpot dashpot(const SphParameters& p, const dvec3& apart, double volume) {
  const double r = glm::length(apart), h = p.support / 2;
  if (r == 0) return {0, 0, dvec3(0), 0};
  const double slope = sph_kernel_derivative(p.kernel, p.dimensions, r, p.support);
  return {0, 0, apart / r,
          -2.0 * (p.dimensions + 2) * p.viscosity * volume * slope * r / (r * r + 0.01 * h * h)};
}

Dashpots dashpots_of(const SphProblem& problem, const SphNeighbourLists& neighbours,
                     const std::vector<double>& densities) {
  const SphParameters& p = problem.parameters;
  const std::vector<vec3>& points = problem.initial.positions;
  const std::vector<double> volumes = sph_wall_volumes(problem);
  Dashpots dashpots;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    for (const std::uint32_t j : neighbours.fluid[i]) {
      if (j < i) continue;  // each pair once
      const double volume = particle_mass(p) * 2 / (densities[i] + densities[j]);
      Dashpot d = dashpot(p, dvec3(points[i]) - dvec3(points[j]), volume);
      d.first = i;
      d.second = j;
      dashpots.pairs.push_back(d);
    }
    for (const std::uint32_t j : neighbours.walls[i]) {
      const double share =
          problem.boundary_motions.empty() ? 1.0 : double(problem.boundary_motions[j].w);
      Dashpot d = dashpot(p, dvec3(points[i]) - dvec3(problem.boundary[j]),
                          share * p.rest_density * volumes[j] / densities[i]);
      d.first = i;
      d.second = j;
      dashpots.walls.push_back(d);
    }
  }
  return dashpots;
}

using Vector = std::vector<dvec3>;

double inner(const Vector& a, const Vector& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += glm::dot(a[i], b[i]);
  return sum;
}

/// (1 + step D) v.
Vector damped(const Dashpots& dashpots, const Vector& v, double step) {
  Vector result = v;
  for (const Dashpot& d : dashpots.pairs) {
    const dvec3 pull = step * d.strength * glm::dot(v[d.first] - v[d.second], d.line) * d.line;
    result[d.first] += pull;
    result[d.second] -= pull;
  }
  for (const Dashpot& d : dashpots.walls)
    result[d.first] += step * d.strength * glm::dot(v[d.first], d.line) * d.line;
  return result;
}

/// Inverses of the blocks on the diagonal of 1 + step D.
std::vector<dmat3> inverse_blocks(const Dashpots& dashpots, std::size_t count, double step) {
  std::vector<dmat3> blocks(count, dmat3(1));
  for (const Dashpot& d : dashpots.pairs) {
    const dmat3 block = step * d.strength * glm::outerProduct(d.line, d.line);
    blocks[d.first] += block;
    blocks[d.second] += block;
  }
  for (const Dashpot& d : dashpots.walls)
    blocks[d.first] += step * d.strength * glm::outerProduct(d.line, d.line);
  for (dmat3& block : blocks) block = glm::inverse(block);
  return blocks;
}

}  // namespace

std::vector<dvec3> sph_viscous_velocities(const SphProblem& problem,
                                          const SphNeighbourLists& neighbours,
                                          const std::vector<double>& densities,
                                          const std::vector<dvec3>& velocities, double step) {
  const Dashpots dashpots = dashpots_of(problem, neighbours, densities);
  const std::vector<dmat3> inverse = inverse_blocks(dashpots, velocities.size(), step);
  const auto preconditioned = [&](const Vector& r) {
    Vector z(r.size());
    for (std::size_t i = 0; i < r.size(); ++i) z[i] = inverse[i] * r[i];
    return z;
  };
  Vector right = velocities;
  for (const Dashpot& d : dashpots.walls)
    right[d.first] +=
        step * d.strength * glm::dot(wall_velocity(problem, d.second), d.line) * d.line;
  // Preconditioned conjugate gradients, Hestenes & Stiefel 1952.
  Vector x = velocities, r = damped(dashpots, x, step);
  for (std::size_t i = 0; i < r.size(); ++i) r[i] = right[i] - r[i];
  Vector z = preconditioned(r), p = z;
  double rz = inner(r, z);
  const double enough = 1e-24 * inner(right, right);
  for (std::size_t k = 0; k < 10 * x.size() + 100 && inner(r, r) > enough; ++k) {
    const Vector ap = damped(dashpots, p, step);
    const double alpha = rz / inner(p, ap);
    for (std::size_t i = 0; i < x.size(); ++i) {
      x[i] += alpha * p[i];
      r[i] -= alpha * ap[i];
    }
    z = preconditioned(r);
    const double next = inner(r, z);
    for (std::size_t i = 0; i < x.size(); ++i) p[i] = z[i] + next / rz * p[i];
    rz = next;
  }
  return x;
}

}  // namespace parity::cpu
