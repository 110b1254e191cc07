// What the kernels of particle fluids and their hosts share. Fields only.
#ifndef PARITY_SPH_LAYOUT_H
#define PARITY_SPH_LAYOUT_H

#include "../shared.h"

#ifdef __cplusplus
namespace parity {
#endif

/// A grid of cells, x fastest: along x half a support wide, else the `reach`-th part of one.
struct SphGrid {
  vec3 low;
  vec3 inverse_cell;  ///< 1/m
  uvec3 cells;
  int reach;    ///< rows to look at on either side along y
  int reach_z;  ///< along z: as many, or 0 in 2 dimensions
};
REF_TYPE(SphGrid, 4)

/// What a fluid is; constant during a run.
struct SphConstants {
  SphGrid grid;
  SphGrid wall_grid;  ///< coarser, as the loops over few particles cost more than the particles
  vec3 gravity;
  float support;
  float inverse_support;  ///< 1/m
  float kernel_scale;  ///< W(0) of the kernel if its polynomial is 1 there
  float mass;
  float rest_density;
  float sound_speed;
  float laminar;       ///< 2 (d + 2) nu of the explicit viscosity
  float implicit;      ///< 2 (d + 2) nu of the implicit viscosity; one of the two is 0
  float artificial;    ///< alpha c h
  float tension;       ///< kappa times the volume at rest
  float softening;     ///< 0.01 h^2
  float wall_share;    ///< of a wall particle's volume that counts, so that fluid at rest fits
  float wave_rate;     ///< bound of omega / c of sound waves, 1/m
  float viscous_rate;  ///< bound of the decay rate of the explicit viscosity, 1/s
  float tension_rate;  ///< bound of omega^2 of the surface tension, 1/s^2
  float courant;
  float fixed_step;
  float max_step;
  float dimensions;
  uint tait;   ///< 1: Tait's equation of state, 0: linear
  uint stiff;  ///< 1: pressure from the equation of state, so sound limits the step
  uint count;
  uint boundary_count;
  uint capacity;  ///< most neighbours of a particle
};
REF_TYPE(SphConstants, 4)

/// Time as the sum of two floats, and what the last step was.
struct SphClock {
  float time;
  float time_rest;
  float step;
  float max_speed;
  float max_acceleration;
  float max_density;
  uint steps;
  uint crowded;  ///< particles with more neighbours than the lists hold, over all steps
};
REF_TYPE(SphClock, 4)

/// Largest of speed^2, acceleration^2, density; count of crowded particles in w's bits.
struct SphLimits {
  float speed;
  float acceleration;
  float density;
  uint crowded;
};
REF_TYPE(SphLimits, 4)

struct CellKeyArgs {
  REF(SphConstants) constants;
  REF(vec4) positions;
  REF(uint) keys;
  REF(uint) ids;
  uint count;
  uint walls;  ///< 1: by the walls' grid
};

struct CellStartArgs {
  REF(uint) keys;    ///< sorted
  REF(uint) starts;  ///< of each cell the number of smaller keys; one more than cells
  uint count;
  uint cell_count;
  uint row;   ///< cells in a row
  uint rows;  ///< along y; 0: of the first cell of each row, else of the others, between those
};

struct GatherArgs {
  REF(uint) ids;
  REF(vec4) from;
  REF(vec4) to;
  uint count;
  uint padding;
};

/// Lists stand in blocks of 64 particles, inside them column by column: neighbour k of particle i at
/// (i - i % 64) * (capacity + 1) + 64 k + i % 64; first the fluid's, then the walls', then what is
/// none.
struct NeighbourArgs {
  REF(SphConstants) constants;
  REF(vec4) positions;  ///< sorted
  REF(uint) starts;
  REF(vec4) boundary;  ///< sorted
  REF(uint) boundary_starts;
  REF(uint) near_walls;  ///< a bit a cell: may a wall particle be within the support?
  REF(uint) lists;
  REF(uvec2) counts;     ///< of fluid neighbours; of all that there are, even those not in the list
  REF(float) densities;  ///< sorted
  uint count;
  uint padding;
};

struct BoundaryVolumeArgs {
  REF(SphConstants) constants;
  REF(vec4) boundary;  ///< sorted
  REF(uint) starts;
  REF(vec4) weighted;  ///< w: rest density times volume
  uint count;
  uint padding;
};

struct DensityArgs {
  REF(SphConstants) constants;
  REF(vec4) positions;   ///< sorted
  REF(vec4) velocities;  ///< of the particles by id
  REF(uint) ids;
  REF(float) densities;  ///< sorted
  REF(vec4) places;      ///< sorted; w: density
  REF(vec4) motions;     ///< sorted velocities; w: p / rho^2
  uint count;
  uint padding;
};

struct ForceArgs {
  REF(SphConstants) constants;
  REF(vec4) places;
  REF(vec4) motions;
  REF(vec4) boundary;
  REF(vec4) boundary_motions;  ///< sorted; w: share of the viscosity
  REF(uint) lists;
  REF(uvec2) counts;
  REF(vec4) accelerations;  ///< sorted
  uint count;
  uint padding;
};

struct LimitsArgs {
  REF(SphConstants) constants;
  REF(vec4) places;
  REF(vec4) motions;
  REF(vec4) accelerations;
  REF(uvec2) counts;
  REF(SphLimits) limits;  ///< one for each block
  uint count;
  uint block;
};

struct ClockArgs {
  REF(SphConstants) constants;
  REF(SphLimits) limits;
  REF(SphClock) clock;
  float until;
  float until_rest;
  uint blocks;
  uint padding;
};

/// How far the solver for the implicit viscosity has come: conjugate gradients.
struct SphViscous {
  uint running;
  uint iterations;
  float alpha;
  float beta;
  float gamma;   ///< residual squared
  float square;  ///< of the solution
};
REF_TYPE(SphViscous, 4)

struct ViscousBeginArgs {
  REF(SphClock) clock;
  REF(vec4) motions;
  REF(vec4) accelerations;
  REF(vec4) solution;
  REF(vec4) direction;
  REF(vec4) image;  ///< of the direction
  REF(SphViscous) solver;
  REF(uint) groups;  ///< of the dispatches of its rounds
  uint count;
  uint block;
};

/// `first`: writes what viscosity adds to `from`, walls moving; else from less that, walls at rest.
struct ViscousApplyArgs {
  REF(SphConstants) constants;
  REF(SphClock) clock;
  REF(vec4) places;
  REF(vec4) boundary;
  REF(vec4) boundary_motions;
  REF(uint) lists;
  REF(uvec2) counts;
  REF(vec4) from;
  REF(vec4) to;
  REF(SphViscous) solver;
  uint count;
  uint first;
};

struct ViscousSumArgs {
  REF(vec4) residual;
  REF(vec4) product;
  REF(vec4) solution;
  REF(vec3) sums;  ///< of each block: r r, r A r, x x
  REF(SphViscous) solver;
  REF(uint) groups;
  uint count;
  uint block;
  float tolerance;  ///< of the residual, relative to the solution
  uint padding;
};

struct ViscousUpdateArgs {
  REF(vec4) residual;
  REF(vec4) product;
  REF(vec4) solution;
  REF(vec4) direction;
  REF(vec4) image;
  REF(SphViscous) solver;
  uint count;
  uint padding;
};

struct ViscousEndArgs {
  REF(SphClock) clock;
  REF(vec4) motions;
  REF(vec4) solution;
  REF(vec4) accelerations;
  uint count;
  uint padding;
};

/// How far the pressure solver has come.
struct SphSolver {
  uint running;
  uint iterations;
  float average;  ///< predicted compression
  float largest;
};
REF_TYPE(SphSolver, 4)

struct SolveBeginArgs {
  REF(SphConstants) constants;
  REF(SphClock) clock;
  REF(uint) ids;
  REF(vec4) places;
  REF(vec4) motions;
  REF(vec4) accelerations;
  REF(vec4) boundary;
  REF(uint) lists;
  REF(uvec2) counts;
  REF(float) pressures;  ///< by id, Pa
  REF(float) impulses;   ///< sorted: step times p / rho^2
  REF(vec4) predicted;   ///< velocities without pressure; w: 1 / diagonal
  REF(SphSolver) solver;
  REF(uint) groups;  ///< of the dispatches of its rounds
  uint count;
  uint block;
  uint divergence;  ///< 1: begin with no pressure and no acceleration
  uint padding;
};

struct SolveArgs {
  REF(SphConstants) constants;
  REF(SphClock) clock;
  REF(vec4) places;
  REF(vec4) boundary;
  REF(uint) lists;
  REF(uvec2) counts;
  REF(vec4) predicted;
  REF(float) impulses;
  REF(vec4) moved;  ///< velocities with pressure; w: predicted compression
  REF(SphSolver) solver;
  uint count;
  uint divergence;  ///< 1: against the rate of density alone, inside the fluid
};

struct SolveCheckArgs {
  REF(vec4) moved;
  REF(vec2) sums;  ///< of each block: sum and largest
  REF(SphSolver) solver;
  REF(uint) groups;
  uint count;
  uint block;
  float tolerance;
  uint least;  ///< rounds to take
};

struct SolvePredictArgs {
  REF(SphClock) clock;
  REF(uint) ids;
  REF(vec4) places;
  REF(vec4) accelerations;
  REF(vec4) moved;
  REF(float) pressures;  ///< by id, Pa
  REF(float) impulses;
  REF(vec4) predicted;
  REF(SphSolver) solver;
  REF(uint) groups;
  uint count;
  uint block;
};

/// Of a vector field, by corrected kernels; columns: derivatives along x, y, z.
struct GradientArgs {
  REF(SphConstants) constants;
  REF(vec4) places;
  REF(vec4) field;  ///< sorted
  REF(uint) lists;
  REF(uvec2) counts;
  REF(uint) ids;
  REF(mat3) gradients;  ///< by id
  uint count;
  uint padding;
};

struct SolveEndArgs {
  REF(SphClock) clock;
  REF(uint) ids;
  REF(vec4) places;
  REF(vec4) moved;
  REF(float) impulses;
  REF(vec4) positions;   ///< by id
  REF(vec4) velocities;  ///< by id
  REF(float) densities;  ///< by id
  REF(float) pressures;  ///< by id
  uint count;
  uint padding;
};

struct IntegrateArgs {
  REF(SphConstants) constants;
  REF(SphClock) clock;
  REF(uint) ids;
  REF(vec4) places;
  REF(vec4) motions;
  REF(vec4) accelerations;
  REF(vec4) positions;   ///< by id
  REF(vec4) velocities;  ///< by id
  REF(float) densities;  ///< by id
  REF(float) pressures;  ///< by id
  uint count;
  uint padding;
};

#ifdef __cplusplus
}  // namespace parity
#endif
#endif
