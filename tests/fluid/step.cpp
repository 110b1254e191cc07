#include "cpu_reference/fluid/step.h"

#include <numbers>

#include "cpu_reference/fluid/advect.h"
#include "cpu_reference/fluid/liquid.h"
#include "cpu_reference/fluid/momentum.h"
#include "cpu_reference/fluid/project.h"
#include "gpu/fluid/step.h"
#include "tests/fluid/fluid_fields.h"
#include "tests/stage.h"

namespace parity {
namespace {

using Problem = FluidStepProblem;
using Cpu = CpuMethod<Problem, FluidState>;
using Gpu = GpuMethod<Problem, FluidState>;

Problem with_method(const Setting& setting) {
  Problem problem = random_fluid_step(setting);
  problem.fluid.parameters.method = FluidMethod(setting.count("method"));
  return problem;
}

std::vector<Axis> axes_with_method(int low, int high) {
  std::vector<Axis> axes = random_fluid_axes();
  axes.push_back({.name = "method",
                  .low = double(low),
                  .high = double(high),
                  .standard = double(high),
                  .whole = true,
                  .each = true});
  return axes;
}

double distance(const FluidState& got, const FluidState& want) { return states_apart(got, want); }

const Registration step_registration = register_stage<Problem, FluidState>(
    {.name = "fluid/step",
     .title = "One step of a fluid on a grid: flow, forces, viscosity, pressure",
     .source = "notes 10.4; Harlow & Welch 1965; Chorin 1968; Shu & Osher 1988",
     .rows = {167},
     .axes = axes_with_method(0, 3),
     .problem = with_method,
     .cpu = {Cpu{
         .solve = [](const Problem& p) { return cpu::step(p.fluid, p.fluid.initial, p.seconds); }}},
     .gpu = {Gpu{.solve =
                     [](gpu::Context& context, const Problem& p) {
                       return gpu::step(context, p.fluid, p.fluid.initial, p.seconds);
                     }}},
     .distance = distance,
     // A trace of up to 2.6 cells and 3 stages of about 60 operations on values that change by as
     // much as they are from cell to cell.
     .tolerance = [](const Problem& p) { return 3 * flow_tolerance(p, 3 * 60 * 2.6); },
     .why =
         "each of up to three projections leaves the divergence asked for, which feeds at most 2 D "
         "L of flow on both sides together; 3 stages of about 60 operations, traces of up to 2.6 "
         "cells through values that change by their size from cell to cell",
     .chart_axes = {"side"}});

const Registration advect_registration = register_stage<Problem, FluidState>(
    {.name = "fluid/advect",
     .title = "Velocity, smoke and heat carried along: semi-Lagrangian and MacCormack",
     .source = "notes 10.4; Stam 1999; Selle et al. 2008",
     .rows = {167},
     .axes = axes_with_method(2, 3),
     .problem = with_method,
     .cpu = {Cpu{.solve =
                     [](const Problem& p) {
                       const FluidState& state = p.fluid.initial;
                       FluidState result = state;
                       for (int axis = 0; axis < 3; ++axis)
                         result.velocity[std::size_t(axis)] = cpu::advect(
                             p.fluid, state, state.velocity[std::size_t(axis)], axis, p.seconds);
                       result.smoke = cpu::advect(p.fluid, state, state.smoke, -1, p.seconds);
                       result.temperature =
                           cpu::advect(p.fluid, state, state.temperature, -1, p.seconds);
                       return result;
                     }}},
     .gpu = {Gpu{.solve =
                     [](gpu::Context& context, const Problem& p) {
                       return gpu::advect(context, p.fluid, p.fluid.initial, p.seconds);
                     }}},
     .distance = distance,
     .tolerance =
         [](const Problem& p) {
           const double cells = p.seconds / p.fluid.domain.spacing;
           return 0x1p-24 * 60 * (1 + 2 * cells) * 2 + 0x1p-24 * 4 * p.fluid.domain.cells.y * 2;
         },
     .why = "a trace is of 60 operations on values up to 1 over `cells` cells, each of which moves "
            "the "
            "place by as much; a place of up to n cells rounds by n 2^-24 four times; the value "
            "changes by 2 in a cell"});

const Registration diffuse_registration = register_stage<Problem, FluidState>(
    {.name = "fluid/diffuse",
     .title = "Viscosity, explicit and implicit",
     .source = "notes 10.4",
     .rows = {169},
     .axes = {{.name = "side", .low = 4, .high = 26, .standard = 12, .whole = true},
              {.name = "dimensions", .low = 2, .high = 3, .standard = 3, .whole = true},
              {.name = "kind", .low = 0, .high = 3, .standard = 3, .whole = true, .each = true},
              {.name = "implicit", .low = 0, .high = 1, .standard = 0, .whole = true},
              {.name = "seconds",
               .unit = "s",
               .low = 1e-3,
               .high = 0.1,
               .standard = 0.02,
               .logarithmic = true}},
     .problem =
         [](const Setting& setting) {
           Problem problem = random_fluid_step(setting);
           problem.fluid.solids.clear();
           problem.fluid.parameters.method = FluidMethod::semi_lagrangian;
           problem.fluid.parameters.implicit_viscosity = setting.count("implicit") == 1;
           // As viscous as the step allows: half of the explicit limit, or five times it.
           problem.fluid.parameters.viscosity = std::pow(problem.fluid.domain.spacing, 2) /
                                                (6 * problem.seconds) *
                                                (setting.count("implicit") == 1 ? 5 : 0.5);
           return problem;
         },
     .cpu = {Cpu{.solve =
                     [](const Problem& p) {
                       FluidState state = p.fluid.initial;
                       const double nu = p.fluid.parameters.viscosity;
                       state.velocity = p.fluid.parameters.implicit_viscosity
                                            ? cpu::diffuse_implicit(p.fluid.domain, state.velocity,
                                                                    nu, p.seconds)
                                            : cpu::diffuse_explicit(p.fluid.domain, state.velocity,
                                                                    nu, p.seconds);
                       return state;
                     }}},
     .gpu = {Gpu{.solve =
                     [](gpu::Context& context, const Problem& p) {
                       return gpu::diffuse(context, p.fluid, p.fluid.initial, p.seconds);
                     }}},
     .distance = distance,
     .tolerance =
         [](const Problem& p) {
           return 0x1p-24 * 40 * 2 + (p.fluid.parameters.implicit_viscosity ? 5e-6 * 2 + 1e-9 : 0);
         },
     .why =
         "40 operations on values up to 2; implicit: 64 sweeps that each shrink what is missing by "
         "(10 / 11)^2 leave 5e-6 of it, the reference 1e-10"});

const Registration project_registration = register_stage<Problem, FluidState>(
    {.name = "fluid/project",
     .title = "A velocity field without divergence, around solids that move",
     .source = "notes 10.4; Chorin 1968; Batty, Bertails & Bridson 2007",
     .rows = {144, 167},
     .axes = random_fluid_axes(),
     .problem =
         [](const Setting& setting) {
           Problem problem = random_fluid_step(setting);
           problem.fluid.parameters.method = FluidMethod::semi_lagrangian;
           return problem;
         },
     .cpu = {Cpu{
         .solve =
             [](const Problem& p) { return cpu::project(p.fluid, p.fluid.initial, p.seconds); }}},
     .gpu = {Gpu{.solve =
                     [](gpu::Context& context, const Problem& p) {
                       return gpu::project(context, p.fluid, p.fluid.initial, p.seconds);
                     }}},
     .distance = distance,
     .tolerance = [](const Problem& p) { return flow_tolerance(p, 100); },
     .why = "both sides leave the divergence asked for, which feeds at most 2 D L of flow; 100 "
            "operations on speeds up to 2",
     .error = [](const Problem& p,
                 const FluidState& state) { return measure(p.fluid, state).divergence; },
     .error_unit = "1/s",
     .chart_axes = {"side"}});

const Registration liquid_registration = register_stage<Problem, FluidState>(
    {.name = "fluid/liquid",
     .title = "One step of a liquid of particles: FLIP and APIC",
     .source = "Zhu & Bridson 2005; Jiang et al. 2015; Bridson 2015, chapter 7",
     .rows = {167},
     .axes = {{.name = "side", .low = 3, .high = 9, .standard = 5, .whole = true},
              {.name = "dimensions", .low = 2, .high = 3, .standard = 3, .whole = true},
              {.name = "method", .low = 4, .high = 5, .standard = 4, .whole = true, .each = true},
              {.name = "seconds",
               .unit = "s",
               .low = 1e-3,
               .high = 0.02,
               .standard = 0.01,
               .logarithmic = true}},
     .problem =
         [](const Setting& setting) {
           Problem problem{
               .fluid = double_dam_break(setting.count("side"), setting.count("dimensions")),
               .seconds = setting.at("seconds")};
           FluidParameters& p = problem.fluid.parameters;
           p.method = FluidMethod(setting.count("method"));
           p.max_iterations = 60;
           p.divergence = 1e-4;
           // A guess that is wrong in the air too, where no solve sets it right.
           Random random(11, 2);
           for (double& pa : problem.fluid.initial.pressure.values) pa = random.uniform(0, 1e4f);
           LiquidParticles& particles = problem.fluid.initial.particles;
           for (std::size_t i = 0; i < particles.count(); ++i) {
             const vec3 x = 3.0f * particles.positions[i];
             const bool flat = problem.fluid.domain.is_flat();
             particles.velocities[i] = {std::sin(x.y), std::cos(x.x), flat ? 0 : std::sin(x.x)};
             if (p.method == FluidMethod::apic)
               particles.gradients[i][0] = {0.5f, std::sin(x.x), 0};
           }
           return problem;
         },
     .cpu = {Cpu{.solve =
                     [](const Problem& p) {
                       return cpu::liquid_step(p.fluid, p.fluid.initial, p.seconds);
                     }}},
     .gpu = {Gpu{.solve =
                     [](gpu::Context& context, const Problem& p) {
                       return gpu::step(context, p.fluid, p.fluid.initial, p.seconds);
                     }}},
     .distance = [](const Problem& p, const FluidState& got,
                    const FluidState& want) { return particles_apart(p.fluid, got, want); },
     .tolerance =
         [](const Problem& p) {
           const double length = p.fluid.domain.spacing * p.fluid.domain.cells.x;
           return 2 * p.fluid.parameters.divergence * length + 300 * 2 * 0x1p-24 +
                  p.fluid.domain.cells.x * 4 * 0x1p-24;
         },
     .why =
         "both sides leave the divergence D asked for, which feeds at most 2 D L of flow; a face "
         "sums up to 144 particles of speeds up to 2 with weights, a particle 24 faces; places of "
         "up to n cells round four times"});

}  // namespace
}  // namespace parity
