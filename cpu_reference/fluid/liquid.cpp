#include "cpu_reference/fluid/liquid.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "cpu_reference/fluid/project.h"
#include "cpu_reference/fluid/tiles.h"

namespace parity::cpu {
namespace {

/// A face near a particle: its weight, the weight's gradient in 1/m, and the way to it in m.
struct Share {
  ivec3 face{0};
  double weight = 0;
  dvec3 slope{0};
  dvec3 way{0};
};

/// The two points of one axis that share a particle.
struct AxisShare {
  std::array<int, 2> point{};
  std::array<double, 2> weight{};
  std::array<double, 2> slope{};
  std::array<double, 2> way{};
};

AxisShare share_axis(const FluidDomain& domain, int axis, int d, double position) {
  const double h = domain.spacing, at = (position - domain.origin[d]) / h - (d == axis ? 0 : 0.5);
  const double whole = std::floor(at), part = at - whole;
  AxisShare share{.point = {int(whole), int(whole) + 1},
                  .weight = {1 - part, part},
                  .slope = {-1 / h, 1 / h},
                  .way = {-part * h, (1 - part) * h}};
  const int last = domain.cells[d] - (d == axis ? 0 : 1);
  for (const std::size_t k : {0u, 1u}) {
    int& point = share.point[k];
    if (domain.is_periodic(d)) {
      point = (point + domain.cells[d]) % domain.cells[d];
      continue;
    }
    if (point >= 0 && point <= last) continue;
    // Beyond the outermost point there is no other: it has all.
    const std::size_t other = 1 - k;
    share.weight[other] = 1;
    share.weight[k] = 0;
    share.slope = {0, 0};
    point = share.point[other];
  }
  return share;
}

std::array<Share, 8> shares(const FluidDomain& domain, int axis, dvec3 position) {
  std::array<AxisShare, 3> axes;
  for (int d = 0; d < 3; ++d) axes[std::size_t(d)] = share_axis(domain, axis, d, position[d]);
  std::array<Share, 8> result;
  for (std::size_t k = 0; k < 8; ++k) {
    const std::array<std::size_t, 3> side{k & 1, (k >> 1) & 1, k >> 2};
    Share& share = result[k];
    share.weight = 1;
    share.slope = dvec3(1);
    for (std::size_t d = 0; d < 3; ++d) {
      const AxisShare& along = axes[d];
      share.face[int(d)] = along.point[side[d]];
      share.way[int(d)] = along.way[side[d]];
      share.weight *= along.weight[side[d]];
      for (std::size_t e = 0; e < 3; ++e)
        share.slope[int(e)] *= e == d ? along.slope[side[d]] : along.weight[side[d]];
    }
  }
  return result;
}

dvec3 kept_inside(const FluidProblem& problem, double time, dvec3 position) {
  const FluidDomain& domain = problem.domain;
  const double margin = 1e-3 * domain.spacing;
  for (int d = 0; d < 3; ++d) {
    const double size = domain.spacing * domain.cells[d];
    double& x = position[d];
    x -= domain.origin[d];
    x = domain.is_periodic(d) ? x - size * std::floor(x / size)
                              : std::clamp(x, margin, size - margin);
    x += domain.origin[d];
  }
  const double distance = solid_distance(problem.solids, time, position);
  if (distance >= margin) return position;
  dvec3 out;
  for (int d = 0; d < 3; ++d) {
    const dvec3 aside = margin * dvec3(axis_step(d));
    out[d] = solid_distance(problem.solids, time, position + aside) -
             solid_distance(problem.solids, time, position - aside);
  }
  const double length = glm::length(out);
  return length > 0 ? position + (margin - distance) / length * out : position;
}

void to_particle(const FluidProblem& problem, const FaceFields& before, const FluidState& after,
                 double seconds, std::size_t i, LiquidParticles& particles) {
  const FluidParameters& p = problem.parameters;
  const dvec3 position(particles.positions[i]);
  dvec3 old(0), now(0);
  dmat3 gradient(0);
  for (int axis = 0; axis < 3; ++axis)
    for (const Share& share : shares(problem.domain, axis, position)) {
      const double speed = after.velocity[std::size_t(axis)](share.face);
      now[axis] += share.weight * speed;
      old[axis] += share.weight * before[std::size_t(axis)](share.face);
      for (int d = 0; d < 3; ++d) gradient[d][axis] += share.slope[d] * speed;
    }
  const bool is_apic = p.method == FluidMethod::apic;
  const dvec3 flip = dvec3(particles.velocities[i]) + now - old;
  particles.velocities[i] = vec3(is_apic ? now : p.flip_ratio * flip + (1 - p.flip_ratio) * now);
  particles.gradients[i] = is_apic ? mat3(gradient) : mat3(0);
  const dvec3 moved = position + seconds * (now + seconds / 2 * (gradient * now));
  particles.positions[i] = vec3(kept_inside(problem, after.time, moved));
}

}  // namespace

FaceTransfer particles_to_faces(const FluidProblem& problem, const LiquidParticles& particles) {
  const FluidDomain& domain = problem.domain;
  FaceTransfer transfer{face_fields(domain.cells), face_fields(domain.cells)};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Field &u = transfer.velocity[axis], &w = transfer.weight[axis];
    for (std::size_t i = 0; i < particles.count(); ++i)
      for (const Share& share : shares(domain, int(axis), dvec3(particles.positions[i]))) {
        double speed = double(particles.velocities[i][int(axis)]);
        for (int d = 0; d < 3; ++d)
          speed += double(particles.gradients[i][d][int(axis)]) * share.way[d];
        u(share.face) += share.weight * speed;
        w(share.face) += share.weight;
      }
    if (domain.is_periodic(int(axis))) {
      // The faces at both ends are one.
      const ivec3 across = domain.cells * axis_step(int(axis));
      for (int z = 0; z < u.size.z; ++z)
        for (int y = 0; y < u.size.y; ++y)
          for (int x = 0; x < u.size.x; ++x) {
            if (ivec3(x, y, z)[int(axis)] != 0) continue;
            u(ivec3(x, y, z) + across) = u(x, y, z);
            w(ivec3(x, y, z) + across) = w(x, y, z);
          }
    }
    for (std::size_t k = 0; k < u.values.size(); ++k)
      if (w.values[k] > 0) u.values[k] /= w.values[k];
  }
  return transfer;
}

FluidState liquid_step(const FluidProblem& problem, const FluidState& state, double seconds) {
  FluidState result = problem.parameters.sparse ? choose_active(problem, state) : state;
  const ActivePoints active(problem.domain, result.active);
  const FaceFields before = particles_to_faces(problem, state.particles).velocity;
  result.velocity = before;
  for (int axis = 0; axis < (problem.domain.is_flat() ? 2 : 3); ++axis) {
    Field& velocity = result.velocity[std::size_t(axis)];
    for (double& u : velocity.values) u += seconds * problem.parameters.force[axis];
    active.clear_rest(axis, velocity);
  }
  result.time = state.time + seconds;
  result = project(problem, result, seconds);
  for (std::size_t i = 0; i < result.particles.count(); ++i)
    to_particle(problem, before, result, seconds, i, result.particles);
  result.steps = state.steps + 1;
  return result;
}

}  // namespace parity::cpu
