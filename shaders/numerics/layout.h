// What the kernels of the numerics chapter and their hosts share. Fields only.
//
// Pressure is stored by colour, as red-black iterations read it: first all cells with x + y + z even
// (red), then all others (black). A row of cells along x holds, for each colour, every second cell;
// four of those are a quad. Quad i of a row holds the cells x = 8 i + s + (0, 2, 4, 6), s the parity
// of y + z + colour. Rows are padded to whole quads; cells beyond the row are 0 and stay 0.
#ifndef PARITY_NUMERICS_LAYOUT_H
#define PARITY_NUMERICS_LAYOUT_H

#include "../shared.h"

#ifdef __cplusplus
namespace parity {
#endif

struct PressureQuad {
  vec4 cells;
};
REF_TYPE(PressureQuad, 16)

/// Two cells of a quad.
struct PressurePair {
  vec2 cells;
};
REF_TYPE(PressurePair, 8)

/// Of four cells: their open fractions in steps of 1/31, 5 bits for each of -x +x -y +y -z +z from
/// bit 0 on, and the bits pressure_fluid and pressure_air.
struct PressureWords {
  uvec4 cells;
};
REF_TYPE(PressureWords, 16)

const uint pressure_fluid = 1u << 30;
const uint pressure_air = 1u << 31;

/// Bits of PressureLevel::flags: side k (-x +x -y +y -z +z) is open or periodic: 1 << k; axis a is
/// periodic: 64 << a.
const uint pressure_periodic = 64u;

/// One grid of a hierarchy. `words` is used where the kernel is specialised for cells that differ;
/// without, all cells are fluid and all faces inside are open.
struct PressureLevel {
  uvec3 cells;
  uint flags;
  REF(PressureQuad) pressure;
  REF(PressureQuad) rhs;
  REF(PressureWords) words;
  uint row;  ///< quads of one colour in a row
  /// Weight of an open side: pressure is 0 half a cell of the finest grid outside it, which is less
  /// than a cell of a coarse grid away.
  float open_weight;
};
REF_TYPE(PressureLevel, 8)

/// Numbers that an iteration leaves for the next command. Zeros begin a solve.
struct SolverControl {
  uint done;        ///< what follows is skipped
  uint iterations;
  float residual;   ///< largest |rhs - A p|
  float tolerance;
  float rho;        ///< z . r
  float alpha;
  float beta;
  float mean;
};
REF_TYPE(SolverControl, 4)

/// Cells of a tile along x, and along y and z.
const uint tile_x = 8u;
const uint tile_yz = 4u;
/// Threads for the faces on top of a tile.
const uint tile_top = 32u;
/// Flags of a tile: it is active; it was until now.
const uint tile_active = 1u;
const uint tile_left = 2u;

/// Where TileTable::groups has the workgroups of 64 threads that cover the listed tiles, three numbers
/// each, in rows of group_row: 4 threads a tile, 16, all its cells; its faces of an axis, three numbers
/// for each axis; the cells of these and of the tiles that were left; cells and faces of the latter
/// alone.
const uint tile_rows = 2u;
const uint tile_quads = 5u;
const uint tile_cells = 8u;
const uint tile_faces = 11u;
const uint touched_cells = 20u;
const uint left_cells = 23u;
const uint left_faces = 26u;
/// There the count of active tiles, listed or not, and those of the listed tiles that no listed one
/// follows along each axis: the faces above them are covered too.
const uint active_tiles = 29u;
const uint last_tiles = 30u;
const uint group_numbers = 33u;
const uint group_row = 32768u;

/// The tiles of a box that are worked on.
struct TileTable {
  REF(uint) flags;   ///< of all tiles of the box, x fastest
  REF(uint) list;    ///< x, y, z in 10 bits each: listed tiles in the order of flags, then the left
  REF(uint) groups;  ///< [0] count of listed tiles, [1] with the left; then as said above
  /// [k]: place in the list of the first active tile of the k-th of 256 equal parts of the box; sums
  /// by these parts do not depend on which tiles are active but hold only zeros.
  REF(uint) starts;
  uint visit_all;  ///< 1: the list has all tiles of the box, active or not
  uint room;  ///< tiles of the box; from [(2 + axis) room] on, the list has those that none follows
};
REF_TYPE(TileTable, 8)

struct TileListArgs {
  REF(TileTable) table;
  REF(float) clock;  ///< 0 there: nothing is done
  uvec3 tiles;
  uint is_flat;
};

struct SweepArgs {
  PressureLevel level;
  REF(PressureQuad) result;
  REF(float) partials;  ///< one a thread
  REF(SolverControl) control;
  REF(TileTable) tiles;  ///< null: the whole box
  uint colour;
  uint run;  ///< cells along z a thread
  float omega;
  uint padding;
};

struct TransferArgs {
  PressureLevel fine;
  PressureLevel coarse;
  REF(SolverControl) control;
  REF(TileTable) tiles;  ///< of the fine grid
  uint mode;
  uint padding;
};

struct SmallCycleArgs {
  REF(PressureLevel) levels;
  REF(SolverControl) control;
  uint first;   ///< level to begin with
  uint count;   ///< of all levels
  uint cycles;  ///< at most; 0: one cycle from a zero guess, unmeasured
  uint sweeps;  ///< on the coarsest level
};

struct VectorArgs {
  REF(PressureQuad) x;
  REF(PressureQuad) x_low;  ///< what x is too coarse to hold
  REF(PressureQuad) d;
  REF(PressureQuad) r;
  REF(PressureQuad) q;
  REF(PressureQuad) z;
  REF(PressureWords) words;
  REF(float) partials;  ///< two a thread
  REF(SolverControl) control;
  REF(TileTable) tiles;
  uvec3 cells;
  uint row;
  uint quads;
  uint run;  ///< quads a thread
  uint mode;
  uint padding;
};

struct ReduceArgs {
  REF(float) partials;
  REF(SolverControl) control;
  REF(TileTable) tiles;  ///< null: the whole box
  uint count;            ///< of partials; with tiles, which leave 4 each: of all tiles of the box
  uint mode;
};

struct PackArgs {
  PressureLevel level;
  REF(uint) types;  ///< CellType of each cell, x fastest
  REF(float) open_x;
  REF(float) open_y;
  REF(float) open_z;
  REF(TileTable) tiles;
  uint keep_tiles;  ///< tiles that are active as before keep their words
  uint padding;
};

#ifdef __cplusplus
}  // namespace parity
#endif
#endif
