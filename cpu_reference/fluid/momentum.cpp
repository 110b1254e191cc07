#include "cpu_reference/fluid/momentum.h"

#include <algorithm>
#include <cmath>

namespace parity::cpu {
namespace {

bool is_closed(const Wall& wall) {
  return wall.kind == WallKind::no_slip || wall.kind == WallKind::free_slip;
}

/// Velocities with a layer of ghost faces around, filled by the walls: then every stencil is plain.
class Padded {
 public:
  Padded(const FluidDomain& domain, const FaceFields& velocity) : domain_(domain) {
    for (int axis = 0; axis < 3; ++axis) {
      const Field& u = velocity[std::size_t(axis)];
      Field& padded = fields_[std::size_t(axis)];
      padded = Field(u.size + 2);
      for (int z = 0; z < u.size.z; ++z)
        for (int y = 0; y < u.size.y; ++y)
          for (int x = 0; x < u.size.x; ++x) padded(x + 1, y + 1, z + 1) = u(x, y, z);
      for (int d = 0; d < 3; ++d) fill_ghosts(padded, axis, d);
    }
  }
  /// `at` may lie one outside.
  double operator()(int axis, ivec3 at) const { return fields_[std::size_t(axis)](at + 1); }

 private:
  void fill_ghosts(Field& u, int axis, int d) {
    const int last = u.size[d] - 1;
    const int period = domain_.cells[d];
    ivec3 size = u.size;
    size[d] = 1;
    for (int z = 0; z < size.z; ++z)
      for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x)
          for (const int side : {0, 1}) {
            ivec3 ghost(x, y, z), inside(x, y, z);
            ghost[d] = side == 0 ? 0 : last;
            const Wall& wall = domain_.walls[std::size_t(2 * d + side)];
            inside[d] = side == 0 ? 1 : last - 1;
            if (wall.kind == WallKind::periodic)
              inside[d] = ghost[d] + (side == 0 ? 1 : -1) * period;
            const bool clings = wall.kind == WallKind::no_slip && d != axis;
            u(ghost) = clings ? 2 * wall.velocity[axis] - u(inside) : u(inside);
          }
  }

  const FluidDomain& domain_;
  FaceFields fields_;
};

/// Sets every face that is not part of a closed wall to value(axis, face).
template <typename Value>
FaceFields each_open_face(const FluidDomain& domain, const Value& value) {
  FaceFields result = face_fields(domain.cells);
  for (int axis = 0; axis < 3; ++axis) {
    Field& field = result[std::size_t(axis)];
    const bool low = is_closed(domain.walls[std::size_t(2 * axis)]);
    const bool high = is_closed(domain.walls[std::size_t(2 * axis + 1)]);
    for (int z = 0; z < field.size.z; ++z)
      for (int y = 0; y < field.size.y; ++y)
        for (int x = 0; x < field.size.x; ++x) {
          const ivec3 face(x, y, z);
          if ((low && face[axis] == 0) || (high && face[axis] == domain.cells[axis])) continue;
          field(face) = value(axis, face);
        }
  }
  return result;
}

double flux_divergence(const Padded& u, FluidMethod method, double h, int axis, ivec3 face) {
  const ivec3 a = axis_step(axis);
  double sum = 0;
  for (int d = 0; d < 3; ++d) {
    const ivec3 e = axis_step(d);
    // Flux of component `axis` along d, half a cell behind the point `to` and before `to - e`.
    const auto flux = [&](ivec3 to) {
      const ivec3 from = to - e;
      const double speed =
          d == axis ? (u(axis, from) + u(axis, to)) / 2 : (u(d, to - a) + u(d, to)) / 2;
      if (method == FluidMethod::upwind) return speed * u(axis, speed > 0 ? from : to);
      return speed * (u(axis, from) + u(axis, to)) / 2;
    };
    sum += flux(face + e) - flux(face);
  }
  return sum / h;
}

double second_difference(const Padded& u, double h, int axis, ivec3 face) {
  double sum = 0;
  for (int d = 0; d < 3; ++d)
    sum += u(axis, face + axis_step(d)) + u(axis, face - axis_step(d)) - 2 * u(axis, face);
  return sum / (h * h);
}

}  // namespace

FaceFields momentum_rate(const FluidProblem& problem, const FaceFields& velocity) {
  const FluidDomain& domain = problem.domain;
  const FluidParameters& p = problem.parameters;
  const Padded u(domain, velocity);
  return each_open_face(domain, [&](int axis, ivec3 face) {
    return p.viscosity * second_difference(u, domain.spacing, axis, face) + p.force[axis] -
           flux_divergence(u, p.method, domain.spacing, axis, face);
  });
}

FaceFields laplacian(const FluidDomain& domain, const FaceFields& velocity) {
  const Padded u(domain, velocity);
  return each_open_face(domain, [&](int axis, ivec3 face) {
    return second_difference(u, domain.spacing, axis, face);
  });
}

FaceFields diffuse_explicit(const FluidDomain& domain, const FaceFields& velocity, double viscosity,
                            double step) {
  FaceFields result = laplacian(domain, velocity);
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i < result[axis].values.size(); ++i)
      result[axis].values[i] = velocity[axis].values[i] + viscosity * step * result[axis].values[i];
  return result;
}

FaceFields diffuse_implicit(const FluidDomain& domain, const FaceFields& velocity, double viscosity,
                            double step) {
  // Richardson's iteration with the diagonal of a cell inside: u += (velocity - A u) / diagonal. At
  // a wall that the fluid clings to the diagonal is larger by at most one half, which keeps it
  // stable.
  const double h = domain.spacing, alpha = viscosity * step / (h * h);
  const double diagonal = 1 + 12 * alpha;
  FaceFields u = velocity;
  for (int sweep = 0; sweep < 20000; ++sweep) {
    const FaceFields curvature = laplacian(domain, u);
    double change = 0, size = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t i = 0; i < u[axis].values.size(); ++i) {
        double& value = u[axis].values[i];
        const double residual =
            velocity[axis].values[i] - (value - alpha * h * h * curvature[axis].values[i]);
        value += residual / diagonal;
        change = std::max(change, std::abs(residual));
        size = std::max(size, std::abs(value));
      }
    if (change <= 1e-10 * size) break;
  }
  return u;
}

}  // namespace parity::cpu
