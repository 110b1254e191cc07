#version 460
#include "numerics/layout.h"
#include "fluid/layout.h"
#include "fluid/grid.glsl"
#include "numerics/tiles.glsl"
#include "fluid/points.glsl"
#include "numerics/words.glsl"

// The right side of the pressure's equations from the flow out of each cell, through open faces and
// with what closes the others; one thread a cell, as the pressure is stored. Source: notes 10.4;
// Batty, Bertails & Bridson 2007; sim/pressure.h.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { FluidProjectArgs args; };

layout(constant_id = 0) const uint with_solids = 0u;

float through(uvec3 cells, uint axis, ivec3 face) {
  const uint index = point_index(points_of(cells, axis), face);
  const float flow = read_face(args.velocity, axis, index);
  if (with_solids == 0u) return flow;
  const float open = read_face(args.open, axis, index);
  precise float sum = open * flow + (1.0 - open) * read_face(args.boundary, axis, index);
  return sum;
}

void main() {
  const float step = args.part * args.clock.at[0].step;
  FluidScene scene = args.scene.at[0];
  PressureLevel level;
  level.cells = scene.cells;
  level.row = (scene.cells.x + 7u) / 8u;
  uint slot = gl_GlobalInvocationID.x;
  if (step == 0.0) return;
  uvec3 cell;
  if (with_tiles != 0u) {
    ivec3 at;
    if (!point_of_thread(scene, 3u, at)) return;
    cell = uvec3(at);
    slot = slot_of_cell(level, cell);
  } else if (slot >= slot_count(level) || !cell_of_slot(level, slot, cell)) {
    return;
  }
  float result = 0.0;
  if (with_solids == 0u ||
      args.types.at[point_index(ivec3(scene.cells), ivec3(cell))] == 0u) {
    precise float sum = 0.0;
    for (uint axis = 0u; axis < 3u; ++axis)
      sum += through(scene.cells, axis, ivec3(cell) + unit(axis)) -
             through(scene.cells, axis, ivec3(cell));
    result = -scene.density * scene.spacing / step * sum;
  }
  ref_float(args.pressure).at[slot] = result;
}
