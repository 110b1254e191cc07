#include "gpu/fluid/fluid_buffers.h"

#include <algorithm>
#include <cmath>

namespace parity::gpu {
namespace {

std::vector<FluidSolidRecord> records_of(const std::vector<FluidSolid>& solids) {
  std::vector<FluidSolidRecord> records;
  for (const FluidSolid& s : solids)
    records.push_back({.center = vec3(s.center),
                       .half_sides = vec3(s.half),
                       .velocity = vec3(s.velocity),
                       .shape = std::uint32_t(s.shape)});
  return records;
}

std::vector<FluidSourceRecord> records_of(const std::vector<FluidSource>& sources) {
  std::vector<FluidSourceRecord> records;
  for (const FluidSource& s : sources)
    records.push_back({.center = vec3(s.center),
                       .radius = float(s.radius),
                       .velocity = vec3(s.velocity),
                       .smoke = float(s.smoke),
                       .temperature = float(s.temperature)});
  return records;
}

double largest_acceleration(const FluidProblem& problem) {
  const FluidParameters& p = problem.parameters;
  double heat = 0, smoke = 0;
  for (const double value : problem.initial.temperature.values)
    heat = std::max(heat, std::abs(value));
  for (const FluidSource& source : problem.sources) {
    heat = std::max(heat, std::abs(source.temperature));
    smoke = std::max(smoke, source.smoke);
  }
  return glm::length(p.force) + p.heat_lift * heat + p.smoke_weight * smoke;
}

}  // namespace

FaceBuffers::FaceBuffers(Context& context, ivec3 cells) {
  for (int axis = 0; axis < 3; ++axis) {
    const ivec3 size = cells + axis_step(axis);
    axes_[std::size_t(axis)] =
        Buffer<float>(context, std::size_t(size.x) * std::size_t(size.y) * std::size_t(size.z));
  }
}

void FaceBuffers::write(const FaceFields& fields) {
  for (std::size_t axis = 0; axis < 3; ++axis) axes_[axis].write(floats_of(fields[axis]));
}

FaceFields FaceBuffers::read(ivec3 cells) const {
  FaceFields fields;
  for (int axis = 0; axis < 3; ++axis)
    fields[std::size_t(axis)] = field_of(cells + axis_step(axis), axes_[std::size_t(axis)].read());
  return fields;
}

std::vector<float> floats_of(const Field& field) {
  return {field.values.begin(), field.values.end()};
}

Field field_of(ivec3 size, const std::vector<float>& values) {
  Field field;
  field.size = size;
  field.values.assign(values.begin(), values.end());
  return field;
}

FluidScene scene_of(const FluidProblem& problem) {
  check_fluid_problem(problem);
  const FluidDomain& domain = problem.domain;
  const FluidParameters& p = problem.parameters;
  FluidScene scene{.cells = uvec3(domain.cells),
                   .spacing = float(domain.spacing),
                   .origin = vec3(domain.origin),
                   .density = float(p.density),
                   .force = vec3(p.force),
                   .viscosity = float(p.viscosity),
                   .heat_lift = float(p.heat_lift),
                   .smoke_weight = float(p.smoke_weight),
                   .cooling = float(p.cooling),
                   .confinement = float(p.vorticity_confinement),
                   .flip_ratio = p.method == FluidMethod::apic ? 0.0f : float(p.flip_ratio),
                   .courant = float(p.courant),
                   .fixed_step = float(p.fixed_step),
                   .max_step = float(p.max_step),
                   .acceleration = float(largest_acceleration(problem)),
                   .divergence = float(p.divergence),
                   .method = std::uint32_t(p.method),
                   .back_trace = p.back_trace == BackTrace::rk2 ? 2u : 3u,
                   .implicit_viscosity = p.implicit_viscosity ? 1u : 0u,
                   .solid_count = std::uint32_t(problem.solids.size()),
                   .source_count = std::uint32_t(problem.sources.size()),
                   .busy_smoke = float(p.busy_smoke),
                   .busy_heat = float(p.busy_heat),
                   .busy_speed = float(p.busy_speed),
                   .margin = std::uint32_t(active_margin(p))};
  for (std::size_t side = 0; side < 6; ++side) {
    scene.walls[side] = std::uint32_t(domain.walls[side].kind);
    scene.wall_velocities[side] = vec3(domain.walls[side].velocity);
  }
  return scene;
}

FluidBuffers::FluidBuffers(Context& context, const FluidProblem& problem)
    : cells(problem.domain.cells),
      with_solids(!problem.solids.empty() || is_liquid(problem.parameters.method) ||
                  problem.parameters.sparse),
      solids(context, records_of(problem.solids)),
      sources(context, records_of(problem.sources)),
      scene(context, 1),
      clock(context, 1),
      velocity(context, cells),
      other(context, cells),
      third(context, cells) {
  FluidScene record = scene_of(problem);
  if (problem.parameters.sparse) {
    tiles = std::make_unique<TileLists>(context, uvec3(cells));
    record.tiles = tiles->table();
  }
  record.solids = solids;
  record.sources = sources;
  scene.write(std::vector<FluidScene>{record});
  if (!with_solids) return;
  open = FaceBuffers(context, cells);
  boundary = FaceBuffers(context, cells);
  types = Buffer<std::uint32_t>(context, problem.domain.cell_count());
}

Threads FluidBuffers::threads(int axis) const {
  const ivec3 size = axis < 3 ? cells + axis_step(axis) : cells;
  return {std::uint32_t(size.x) * std::uint32_t(size.y) * std::uint32_t(size.z)};
}

}  // namespace parity::gpu
