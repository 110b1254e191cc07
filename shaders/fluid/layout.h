// What the kernels of the fluid chapter and their hosts share. Fields only. Fields of cells and faces
// are arrays of floats, x fastest; sim/fluid.h says which face is which. Needs numerics/layout.h
// before it.
#ifndef PARITY_FLUID_LAYOUT_H
#define PARITY_FLUID_LAYOUT_H

#include "../shared.h"

#ifdef __cplusplus
namespace parity {
#endif

/// Numbers of WallKind and FluidMethod, sim/fluid.h.
const uint wall_no_slip = 0u;
const uint wall_free_slip = 1u;
const uint wall_open = 2u;
const uint wall_periodic = 3u;
const uint fluid_upwind = 0u;
const uint fluid_central = 1u;
/// Parts of an axis' listed faces that the largest speed is found in.
const uint tile_speeds = 256u;

struct FluidSolidRecord {
  vec3 center;  ///< m, at time 0
  vec3 half_sides;
  vec3 velocity;
  uint shape;
};
REF_TYPE(FluidSolidRecord, 4)

struct FluidSourceRecord {
  vec3 center;
  float radius;
  vec3 velocity;
  float smoke;
  float temperature;
};
REF_TYPE(FluidSourceRecord, 4)

/// What stays as it is while a simulation runs.
struct FluidScene {
  uvec3 cells;
  float spacing;
  vec3 origin;
  float density;
  vec3 force;
  float viscosity;
  float heat_lift;
  float smoke_weight;
  float cooling;
  float confinement;
  float flip_ratio;
  float courant;
  float fixed_step;
  float max_step;
  float acceleration;  ///< largest that forces may give
  float divergence;    ///< 1/s that the projection may leave
  uint method;
  uint back_trace;  ///< order of the Runge-Kutta method, 2 or 3
  uint implicit_viscosity;
  uint solid_count;
  uint source_count;
  float busy_smoke;  ///< what makes a block busy, sim/fluid.h
  float busy_heat;
  float busy_speed;
  uint margin;  ///< cells that a tile may lie beside a busy one and be active
  uint walls[6];
  vec3 wall_velocities[6];
  REF(TileTable) tiles;  ///< null: the whole box
  REF(FluidSolidRecord) solids;
  REF(FluidSourceRecord) sources;
};
REF_TYPE(FluidScene, 8)

/// What changes with every step.
struct FluidClock {
  float step;  ///< s; 0: nothing is to be done
  float time;  ///< s, at the begin of the step
  float end;   ///< s, not to be passed
  float speed; ///< m/s, sum over the axes of the largest on each
  uint steps;
  uint unconverged;  ///< projections that kept more divergence than asked
};
REF_TYPE(FluidClock, 4)

struct FluidFaces {
  REF(float) x;
  REF(float) y;
  REF(float) z;
};

/// One set of arguments for all kernels on fields; each says which it uses.
struct FluidArgs {
  REF(FluidScene) scene;
  REF(FluidClock) clock;
  FluidFaces velocity;
  FluidFaces other;
  FluidFaces result;
  REF(float) field;
  REF(float) field_result;
  uint axis;  ///< 0 to 2: faces; 3: cells
  uint mode;
  float weight;
};

/// What is where, by tiles.
struct FluidTileArgs {
  REF(FluidScene) scene;
  REF(FluidClock) clock;
  FluidFaces velocity;
  REF(float) smoke;
  REF(float) temperature;
  REF(uint) ranges;  ///< of particles in cells, as in LiquidArgs
  REF(uint) held;    ///< four a tile, one for each z in it: bits of the cells that sources hold
  REF(uint) busy;    ///< the same of all busy cells
  uint is_liquid;
  uint padding;
};

/// What solids do to faces and cells.
struct FluidCellArgs {
  REF(FluidScene) scene;
  REF(FluidClock) clock;
  FluidFaces open;
  FluidFaces boundary;
  REF(uint) types;
  REF(uint) ranges;  ///< of particles in cells, as in LiquidArgs; null: no liquid
  uint axis;
  uint is_liquid;
};

/// Smoke and temperature as the flow carries them.
struct FluidCarryArgs {
  REF(FluidScene) scene;
  REF(FluidClock) clock;
  FluidFaces velocity;
  REF(float) smoke;
  REF(float) temperature;
  REF(float) smoke_forth;  ///< carried forth by the semi-Lagrangian method
  REF(float) temperature_forth;
  REF(float) carried_smoke;  ///< and corrected
  REF(float) carried_temperature;
  uint mode;
  uint padding;
};

/// Smoke and temperature, and the forces of both.
struct FluidScalarArgs {
  REF(FluidScene) scene;
  REF(FluidClock) clock;
  FluidFaces velocity;
  FluidFaces pushed;  ///< the velocity with what forces add
  REF(float) carried_smoke;
  REF(float) carried_temperature;
  REF(float) smoke;
  REF(float) temperature;
  REF(vec4) vorticity;  ///< of cells, and its magnitude
  REF(vec4) spin;       ///< acceleration of confinement, m/s^2
  uint axis;
  uint mode;
};

/// Particles of a liquid, in the order of their ids, and what lies where.
struct LiquidArgs {
  REF(FluidScene) scene;
  REF(FluidClock) clock;
  REF(vec3) positions;
  REF(vec3) velocities;
  REF(mat3) gradients;
  REF(uint) keys;    ///< cells of particles, sorted
  REF(uint) sorted;  ///< ids in the order of keys; ids of a cell ascend
  REF(uint) ranges;  ///< of each cell: first place in `sorted`, and one behind the last
  FluidFaces velocity;
  FluidFaces old;
  uint axis;
  uint count;
};

struct FluidProjectArgs {
  REF(FluidScene) scene;
  REF(FluidClock) clock;
  FluidFaces velocity;
  FluidFaces open;      ///< null: no solids
  FluidFaces boundary;  ///< velocity of what closes a face
  REF(uint) types;      ///< of cells; null: all fluid
  REF(PressureQuad) pressure;
  REF(PressureQuad) pressure_low;  ///< null: none
  REF(SolverControl) control;
  uint mode;   ///< axis in bits 1 and 2
  float part;  ///< of the step that this projection is for
};

#ifdef __cplusplus
}  // namespace parity
#endif
#endif
