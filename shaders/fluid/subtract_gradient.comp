#version 460
#include "numerics/layout.h"
#include "fluid/layout.h"
#include "fluid/grid.glsl"
#include "numerics/tiles.glsl"
#include "fluid/points.glsl"
#include "numerics/words.glsl"

// Takes the pressure's gradient off the velocity of every open face beside fluid; closed faces move
// with what closes them. One thread a face. Source: notes 10.4.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { FluidProjectArgs args; };

layout(constant_id = 0) const uint with_solids = 0u;

/// Pressure of a cell in two parts; 0 beyond open sides.
vec2 pressure_at(FluidScene scene, PressureLevel level, ivec3 cell, uint axis) {
  const int count = int(scene.cells[axis]);
  if (wraps(scene, axis)) cell[axis] = (cell[axis] + count) % count;
  if (cell[axis] < 0 || cell[axis] >= count) return vec2(0.0);
  const uint slot = slot_of_cell(level, uvec3(cell));
  return vec2(ref_float(args.pressure).at[slot],
              (args.mode & 1u) != 0u ? ref_float(args.pressure_low).at[slot] : 0.0);
}

bool is_fluid(FluidScene scene, ivec3 cell, uint axis) {
  const int count = int(scene.cells[axis]);
  if (wraps(scene, axis)) cell[axis] = (cell[axis] + count) % count;
  if (cell[axis] < 0 || cell[axis] >= count) return false;
  return args.types.at[point_index(ivec3(scene.cells), cell)] == 0u;
}

void main() {
  FluidScene scene = args.scene.at[0];
  const float step = args.part * args.clock.at[0].step;
  const uint axis = args.mode >> 1u;
  ivec3 face;
  if (!point_of_thread(scene, axis, face) || step == 0.0) return;
  const uint index = point_index(points_of(scene.cells, axis), face);
  if (in_closed_wall(scene, axis, face)) {
    write_face(args.velocity, axis, index, 0.0);
    return;
  }
  if (with_solids != 0u) {
    if (read_face(args.open, axis, index) == 0.0) {
      write_face(args.velocity, axis, index, read_face(args.boundary, axis, index));
      return;
    }
    if (!is_fluid(scene, face, axis) && !is_fluid(scene, face - unit(axis), axis)) return;
  }
  PressureLevel level;
  level.cells = scene.cells;
  level.row = (scene.cells.x + 7u) / 8u;
  const vec2 above = pressure_at(scene, level, face, axis);
  const vec2 below = pressure_at(scene, level, face - unit(axis), axis);
  precise float difference = (above.x - below.x) + (above.y - below.y);
  precise float speed = read_face(args.velocity, axis, index) -
                        step / (scene.density * scene.spacing) * difference;
  write_face(args.velocity, axis, index, speed);
}
