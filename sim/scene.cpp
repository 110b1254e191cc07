#include "sim/scene.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "sim/fluid.h"

namespace parity {
namespace {

constexpr const char* side_names[6] = {"left", "right", "bottom", "top", "back", "front"};

dvec3 low_of(const SimShape& s) {
  return s.kind == SimShape::Kind::box ? s.low : s.center - dvec3(s.radius);
}
dvec3 high_of(const SimShape& s) {
  return s.kind == SimShape::Kind::box ? s.high : s.center + dvec3(s.radius);
}

bool is_inside(const SimScene& scene, const SimShape& shape) {
  const dvec3 low = low_of(shape), high = high_of(shape);
  for (int a = 0; a < scene.dimensions; ++a) {
    const double slack = 1e-9 * scene.size[a];  // 0.1 x 3 is no 0.3
    if (low[a] < -slack || high[a] > scene.size[a] + slack) return false;
  }
  return true;
}

bool touches(const SimScene& scene, const SimShape& shape) {
  const dvec3 low = low_of(shape), high = high_of(shape);
  for (int a = 0; a < scene.dimensions; ++a)
    if (!(high[a] > 0 && low[a] < scene.size[a])) return false;
  return true;
}

std::string place(const char* list, std::size_t i) {
  return std::string(list) + "[" + std::to_string(i) + "]";
}

/// Whether solids cover every point of a lattice of up to 33 points a side.
bool is_solid_everywhere(const SimScene& scene) {
  constexpr int n = 33;
  const int depth = scene.dimensions == 3 ? n : 1;
  for (int k = 0; k < depth; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const dvec3 p = scene.size * dvec3(i + 0.5, j + 0.5, depth == 1 ? 0 : k + 0.5) / double(n);
        if (std::ranges::none_of(scene.solids,
                                 [&](const SimBody& b) { return contains(b.shape, p); }))
          return false;
      }
  return true;
}

std::string side_fault(const SimScene& scene) {
  for (int s = 0; s < 2 * scene.dimensions; ++s) {
    const SimSide& side = scene.sides[s];
    const std::string name = std::string("domain.sides.") + side_names[s];
    if ((side.kind == SimSideKind::periodic) != (scene.sides[s ^ 1].kind == SimSideKind::periodic))
      return name + ": a side is periodic if and only if the opposite one is";
    if (side.velocity[s / 2] != 0)
      return name + ".velocity: a wall may slide along itself only, not towards the fluid";
    if (is_sph(scene.method) && side.kind == SimSideKind::periodic)
      return name + ": method " + name_of(scene.method) + " has no periodic sides";
    if (is_sph(scene.method) && side.kind == SimSideKind::open && s != 3)
      return name + ": method " + name_of(scene.method) + " may be open at the top only";
  }
  return {};
}

std::string sparse_fault(const SimScene& scene) {
  if (!scene.solver.sparse) return {};
  const bool is_grid = scene.method == SimMethod::grid;
  if (is_sph(scene.method))
    return std::string("solver.sparse: method ") + name_of(scene.method) +
           " has no cells; use grid, flip or apic";
  if (is_grid && scene.solver.advection <= SimAdvection::central)
    return "solver.sparse: needs advection semi_lagrangian or maccormack";
  for (int s = 0; s < 2 * scene.dimensions; ++s)
    if (scene.sides[s].kind == SimSideKind::periodic)
      return std::string("solver.sparse: domain.sides.") + side_names[s] + " is periodic";
  for (std::size_t i = 0; is_grid && i < scene.solids.size(); ++i)
    if (scene.solids[i].velocity != dvec3(0))
      return "solver.sparse: " + place("solids", i) + " moves, which method grid cannot";
  if (scene.solver.courant.value_or(1) > 3)
    return "solver.courant is " + std::to_string(*scene.solver.courant) +
           ", must be at most 3 where sparse";
  const ivec3 tiles = (cells_of(scene) + fluid_tile - 1) / fluid_tile;
  const long long count = 1LL * tiles.x * tiles.y * tiles.z;
  if (count > 65535)
    return "solver.sparse: gives " + std::to_string(count) +
           " tiles of 8 x 4 x 4 cells, at most 65535 are allowed";
  return {};
}

std::string error_fault(const SimScene& scene) {
  if (!scene.solver.error) return {};
  if (scene.method != SimMethod::grid)
    return std::string("solver.error: method ") + name_of(scene.method) +
           " chooses its steps by speed alone; use grid";
  if (scene.solver.sparse) return "solver.error: is not for sparse scenes";
  return {};
}

std::string shape_fault(const SimScene& scene) {
  for (std::size_t i = 0; i < scene.liquid.size(); ++i)
    if (!is_inside(scene, scene.liquid[i].shape))
      return place("liquid", i) + ": sticks out of the domain";
  for (std::size_t i = 0; i < scene.solids.size(); ++i)
    if (!touches(scene, scene.solids[i].shape))
      return place("solids", i) + ": lies outside the domain";
  for (std::size_t i = 0; i < scene.sources.size(); ++i) {
    const SimSource& source = scene.sources[i];
    const SimShape ball{
        .kind = SimShape::Kind::sphere, .center = source.center, .radius = source.radius};
    if (!is_inside(scene, ball)) return place("sources", i) + ": sticks out of the domain";
  }
  if (is_solid_everywhere(scene)) return "solids: leave no room for the fluid";
  return {};
}

}  // namespace

const char* name_of(SimMethod method) {
  constexpr const char* names[] = {"grid", "flip", "apic", "wcsph", "dfsph"};
  return names[int(method)];
}

bool contains(const SimShape& shape, const dvec3& p) {
  if (shape.kind == SimShape::Kind::sphere) return glm::length(p - shape.center) <= shape.radius;
  return glm::all(glm::greaterThanEqual(p, shape.low)) &&
         glm::all(glm::lessThanEqual(p, shape.high));
}

ivec3 cells_of(const SimScene& scene) {
  const auto cells = [&](double side) {
    return std::max(1, int(std::lround(side / scene.spacing)));
  };
  return {cells(scene.size.x), cells(scene.size.y),
          scene.dimensions == 3 ? cells(scene.size.z) : 1};
}

int frame_count(const SimScene& scene) {
  return int(std::lround(scene.duration * scene.frames_per_second));
}

void set_resolution(SimScene& scene, int cells) {
  if (cells < 2 || cells > 4096)
    throw std::invalid_argument("resolution is " + std::to_string(cells) +
                                ", must be from 2 to 4096");
  scene.spacing =
      std::max({scene.size.x, scene.size.y, scene.dimensions == 3 ? scene.size.z : 0.0}) / cells;
  if (const std::string fault = scene_fault(scene); !fault.empty())
    throw std::invalid_argument(fault);
}

std::string scene_fault(const SimScene& scene) {
  double cells = 1;
  for (int a = 0; a < scene.dimensions; ++a) {
    const double along = scene.size[a] / scene.spacing;
    if (along < 1)
      return "domain.size: is less than one spacing of " + std::to_string(scene.spacing) + " m";
    cells *= along;
  }
  if (cells > max_sim_cells)
    return "resolution: asks for " + std::to_string(cells / 1e6) +
           " million cells, at most 134 million are allowed";
  double volume = 0;
  for (const SimBody& body : scene.liquid) {
    const dvec3 side = glm::max(high_of(body.shape) - low_of(body.shape), dvec3(scene.spacing));
    volume += side.x * side.y * (scene.dimensions == 3 ? side.z : 1);
  }
  const double particles = volume / std::pow(scene.spacing, scene.dimensions) *
                           (is_sph(scene.method) ? 1 : (scene.dimensions == 3 ? 8 : 4));
  if (particles > max_sim_particles)
    return "resolution: asks for " + std::to_string(particles / 1e6) +
           " million particles, at most 8 million are allowed";
  if (scene.duration * scene.frames_per_second > max_sim_frames)
    return "duration: gives " + std::to_string(scene.duration * scene.frames_per_second) +
           " frames, at most 100000 are allowed";
  if (const std::string fault = side_fault(scene); !fault.empty()) return fault;
  if (const std::string fault = shape_fault(scene); !fault.empty()) return fault;
  if (const std::string fault = sparse_fault(scene); !fault.empty()) return fault;
  if (const std::string fault = error_fault(scene); !fault.empty()) return fault;
  const bool is_grid = scene.method == SimMethod::grid;
  if (is_grid && !scene.liquid.empty())
    return "liquid: method grid fills the domain; use flip, apic, wcsph or dfsph for liquids";
  if (!is_grid && scene.liquid.empty()) return "liquid: is missing";
  if (!is_grid && !scene.sources.empty())
    return std::string("sources: method ") + name_of(scene.method) + " has none; use grid";
  if (!is_grid && scene.start != SimStart::rest)
    return std::string("start: method ") + name_of(scene.method) + " begins at rest";
  return {};
}

}  // namespace parity
