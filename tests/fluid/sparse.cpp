#include <algorithm>
#include <cmath>

#include "cpu_reference/fluid/liquid.h"
#include "cpu_reference/fluid/step.h"
#include "gpu/fluid/step.h"
#include "tests/fluid/fluid_fields.h"
#include "tests/stage.h"

/// Sparse fluids: only tiles near what moves are computed.
namespace parity {
namespace {

using Problem = FluidStepProblem;
using Cpu = CpuMethod<Problem, FluidState>;
using Gpu = GpuMethod<Problem, FluidState>;

/// Sets what lies outside of a box, in parts of the domain, to rest.
void keep_inside(FluidProblem& problem, dvec3 low, dvec3 high) {
  FluidState& state = problem.initial;
  const dvec3 size = problem.domain.spacing * dvec3(problem.domain.cells);
  const auto keep = [&](int axis, Field& field) {
    for (int z = 0; z < field.size.z; ++z)
      for (int y = 0; y < field.size.y; ++y)
        for (int x = 0; x < field.size.x; ++x) {
          const dvec3 at = point_position(problem.domain, axis, {x, y, z}) / size;
          if (glm::any(glm::lessThan(at, low)) || glm::any(glm::greaterThan(at, high)))
            field(x, y, z) = 0;
        }
  };
  for (int axis = 0; axis < 3; ++axis) keep(axis, state.velocity[std::size_t(axis)]);
  keep(-1, state.smoke);
  keep(-1, state.temperature);
}

/// Random smoke in a corner of a box, by kinds as random_fluid_step; 3: a liquid.
Problem sparse_step(const Setting& setting) {
  const bool liquid = setting.count("kind") == 3;
  Problem problem = random_fluid_step(setting);
  FluidProblem& fluid = problem.fluid;
  for (FluidSolid& solid : fluid.solids) solid.velocity = dvec3(0);
  fluid.sources[0].radius = 0.06;
  if (liquid) {
    fluid = dam_break(std::max(setting.count("side") / 3, 2), 1, setting.count("dimensions"));
    fluid.parameters.max_iterations = 60;
    fluid.parameters.divergence = 1e-4;
    for (std::size_t i = 0; i < fluid.initial.particles.count(); ++i) {
      const vec3 x = 3.0f * fluid.initial.particles.positions[i];
      fluid.initial.particles.velocities[i] = {std::sin(x.y), std::cos(x.x), 0};
    }
  }
  fluid.parameters.sparse = true;
  fluid.parameters.courant = 1;
  if (!liquid) keep_inside(fluid, dvec3(0.5, 0.55, 0), dvec3(0.9, 0.85, 1));
  return problem;
}

double distance(const Problem& p, const FluidState& got, const FluidState& want) {
  if (got.active != want.active) return 1e9;
  if (!is_liquid(p.fluid.parameters.method)) return states_apart(got, want);
  double largest = 0;
  for (std::size_t i = 0; i < want.particles.count(); ++i)
    largest = std::max(
        {largest,
         double(glm::distance(got.particles.positions[i], want.particles.positions[i])) /
             p.fluid.domain.spacing,
         double(glm::distance(got.particles.velocities[i], want.particles.velocities[i]))});
  return largest;
}

const Registration sparse_registration = register_stage<Problem, FluidState>(
    {.name = "fluid/sparse",
     .title = "One step of a fluid in active tiles only",
     .source = "notes 10.4; Museth 2013 for sparse grids",
     .rows = {167},
     .axes = {{.name = "side", .low = 9, .high = 26, .standard = 20, .whole = true},
              {.name = "dimensions", .low = 2, .high = 3, .standard = 3, .whole = true},
              {.name = "kind", .low = 0, .high = 3, .standard = 1, .whole = true, .each = true},
              {.name = "seconds",
               .unit = "s",
               .low = 1e-3,
               .high = 0.02,
               .standard = 0.01,
               .logarithmic = true}},
     .problem = sparse_step,
     .cpu = {Cpu{.solve =
                     [](const Problem& p) {
                       return is_liquid(p.fluid.parameters.method)
                                  ? cpu::liquid_step(p.fluid, p.fluid.initial, p.seconds)
                                  : cpu::step(p.fluid, p.fluid.initial, p.seconds);
                     }}},
     .gpu = {Gpu{.solve =
                     [](gpu::Context& context, const Problem& p) {
                       return gpu::step(context, p.fluid, p.fluid.initial, p.seconds);
                     }}},
     .distance = distance,
     .tolerance = [](const Problem& p) { return 3 * flow_tolerance(p, 3 * 60 * 2.6); },
     .why =
         "as fluid/step and fluid/liquid: both sides leave the divergence asked for, which feeds "
         "at most 2 D L of flow; traces of up to 2.6 cells through values that change by their "
         "size from cell to cell. Which cells are active must agree",
     .chart_axes = {"side"}});

}  // namespace
}  // namespace parity
