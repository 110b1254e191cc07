#include "cpu_reference/fluid/advect.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "cpu_reference/fluid/tiles.h"

namespace parity::cpu {
namespace {

/// The eight points around a position, with repetition at borders, and their weights.
struct Corners {
  std::array<std::size_t, 8> index{};
  std::array<double, 8> weight{};
};

Corners corners_at(const FluidDomain& domain, const Field& field, int axis, dvec3 position) {
  std::array<std::array<int, 2>, 3> points{};
  std::array<double, 3> part{};
  for (int d = 0; d < 3; ++d) {
    double at = (position[d] - domain.origin[d]) / domain.spacing - (d == axis ? 0 : 0.5);
    const auto k = std::size_t(d);
    if (domain.is_periodic(d)) {
      const int period = domain.cells[d];
      const double whole = std::floor(at);
      part[k] = at - whole;
      const int low = ((int(whole) % period) + period) % period;
      points[k] = {low, (low + 1) % period};
    } else {
      at = std::clamp(at, 0.0, double(field.size[d] - 1));
      const int low = std::min(int(at), std::max(field.size[d] - 2, 0));
      part[k] = at - low;
      points[k] = {low, std::min(low + 1, field.size[d] - 1)};
    }
  }
  Corners corners;
  for (std::size_t k = 0; k < 8; ++k) {
    const std::size_t x = k & 1, y = (k >> 1) & 1, z = k >> 2;
    corners.index[k] = field.index(points[0][x], points[1][y], points[2][z]);
    corners.weight[k] =
        (x ? part[0] : 1 - part[0]) * (y ? part[1] : 1 - part[1]) * (z ? part[2] : 1 - part[2]);
  }
  return corners;
}

dvec3 velocity_at(const FluidDomain& domain, const FaceFields& velocity, dvec3 position) {
  dvec3 u;
  for (int axis = 0; axis < 3; ++axis)
    u[axis] = sample(domain, velocity[std::size_t(axis)], axis, position);
  return u;
}

/// Where the fluid at a position was `seconds` ago.
dvec3 trace_back(const FluidProblem& problem, const FaceFields& velocity, dvec3 position,
                 double seconds) {
  const auto u = [&](dvec3 at) { return velocity_at(problem.domain, velocity, at); };
  const dvec3 k1 = u(position);
  const dvec3 k2 = u(position - seconds / 2 * k1);
  if (problem.parameters.back_trace == BackTrace::rk2) return position - seconds * k2;
  const dvec3 k3 = u(position - seconds * 3 / 4 * k2);
  return position - seconds * (2.0 / 9 * k1 + 3.0 / 9 * k2 + 4.0 / 9 * k3);
}

bool in_closed_wall(const FluidDomain& domain, int axis, ivec3 point) {
  if (axis < 0 || (point[axis] != 0 && point[axis] != domain.cells[axis])) return false;
  const WallKind kind = domain.walls[std::size_t(2 * axis + (point[axis] == 0 ? 0 : 1))].kind;
  return kind == WallKind::no_slip || kind == WallKind::free_slip;
}

}  // namespace

double sample(const FluidDomain& domain, const Field& field, int axis, dvec3 position) {
  const Corners corners = corners_at(domain, field, axis, position);
  double value = 0;
  for (std::size_t k = 0; k < 8; ++k) value += corners.weight[k] * field.values[corners.index[k]];
  return value;
}

Field advect(const FluidProblem& problem, const FluidState& state, const Field& field, int axis,
             double seconds) {
  const FluidMethod method = problem.parameters.method;
  if (method != FluidMethod::semi_lagrangian && method != FluidMethod::maccormack)
    throw std::invalid_argument("cpu::advect: method must be semi_lagrangian or maccormack");
  const FluidDomain& domain = problem.domain;
  const ActivePoints active(domain, state.active);
  const auto for_points = [&](const auto& visit) {
    for (int z = 0; z < field.size.z; ++z)
      for (int y = 0; y < field.size.y; ++y)
        for (int x = 0; x < field.size.x; ++x)
          if (!in_closed_wall(domain, axis, {x, y, z}) && active.has(axis, {x, y, z}))
            visit(ivec3(x, y, z));
  };
  const auto source = [&](ivec3 point, double time) {
    return trace_back(problem, state.velocity, point_position(domain, axis, point), time);
  };
  Field forth(field.size);
  for_points(
      [&](ivec3 point) { forth(point) = sample(domain, field, axis, source(point, seconds)); });
  if (method == FluidMethod::semi_lagrangian) return forth;
  Field result(field.size);
  for_points([&](ivec3 point) {
    const double back = sample(domain, forth, axis, source(point, -seconds));
    const Corners around = corners_at(domain, field, axis, source(point, seconds));
    double low = field.values[around.index[0]], high = low;
    for (const std::size_t i : around.index) {
      low = std::min(low, field.values[i]);
      high = std::max(high, field.values[i]);
    }
    result(point) = std::clamp(forth(point) + (field(point) - back) / 2, low, high);
  });
  return result;
}

}  // namespace parity::cpu
