// Which point of a field a thread is for. Needs fluid/grid.glsl and numerics/tiles.glsl.

/// Cell `slot` of a tile, or the face below it. False: there is none.
bool point_in_tile(uvec3 cells, uvec3 tile, uint slot, out ivec3 at) {
  at = ivec3(cell_in_tile(tile, slot));
  return all(lessThan(at, ivec3(cells)));
}

/// Face `slot` of those above the last cells of a tile. False: there is none.
bool point_on_top(uvec3 cells, uint axis, uvec3 tile, uint slot, out ivec3 at) {
  const uint wide = axis == 0u ? 2u : 3u;  // x and y, or y and z, where x is the axis
  const uint first = slot & ((1u << wide) - 1u), second = slot >> wide;
  uvec3 step = axis == 0u ? uvec3(tile_x, first, second) : uvec3(first, second, second);
  if (axis > 0u) step[axis] = tile_yz;
  uvec3 point = tile_side * tile + step;
  point[axis] = min(point[axis], cells[axis]);
  at = ivec3(point);
  return second < tile_yz && all(lessThan(at, points_of(cells, axis)));
}

/// Slots of the listed tiles' cells, or of their faces of an axis: those below their cells, then those
/// on top of the tiles that no listed one follows.
uint slots_of_list(FluidScene scene, uint axis) {
  TileTable table = scene.tiles.at[0];
  const uint below = table.groups.at[0] << tile_bits(scene.cells);
  return axis > 2u ? below : below + tile_top * table.groups.at[last_tiles + axis];
}

/// The point of a slot. False: there is none.
bool point_of_slot(FluidScene scene, uint axis, uint slot, out ivec3 at) {
  TileTable table = scene.tiles.at[0];
  const uint bits = tile_bits(scene.cells), below = table.groups.at[0] << bits;
  const uint slots = slots_of_list(scene, axis);
  if (slot < below) {
    const uint tile = table.list.at[slot >> bits];
    return point_in_tile(scene.cells, tile_at(tile), slot & ((1u << bits) - 1u), at);
  }
  at = ivec3(0);
  if (slot >= slots) return false;
  const uint on_top = slot - below;
  const uint tile = table.list.at[(2u + axis) * table.room + on_top / tile_top];
  return point_on_top(scene.cells, axis, tile_at(tile), on_top % tile_top, at);
}

/// Without tiles: points in the order of the field. With: those of the listed tiles, active or not.
bool listed_point_of_thread(FluidScene scene, uint axis, out ivec3 at) {
  if (with_tiles != 0u) return point_of_slot(scene, axis, thread_of_tiles(), at);
  const ivec3 size = points_of(scene.cells, axis);
  at = point_of(size, gl_GlobalInvocationID.x);
  return gl_GlobalInvocationID.x < point_count(size);
}

/// Cells of the listed tiles and of those that were left, which stand in the list behind them.
bool touched_cell_of_thread(FluidScene scene, out ivec3 at) {
  if (with_tiles == 0u) return listed_point_of_thread(scene, 3u, at);
  TileTable table = scene.tiles.at[0];
  const uint bits = tile_bits(scene.cells), slot = thread_of_tiles();
  return slot >> bits < table.groups.at[1] &&
         point_in_tile(scene.cells, tile_at(table.list.at[slot >> bits]), slot & ((1u << bits) - 1u), at);
}

bool in_active_tile(FluidScene scene, ivec3 cell) {
  return all(greaterThanEqual(cell, ivec3(0))) && all(lessThan(cell, ivec3(scene.cells))) &&
         is_active(scene.tiles.at[0], scene.cells, uvec3(cell) / tile_side);
}

/// A cell of an active tile, or a face with one beside it.
bool is_active_point(FluidScene scene, uint axis, ivec3 at) {
  return in_active_tile(scene, at) || (axis < 3u && in_active_tile(scene, at - unit(axis)));
}

/// The point that the thread works on.
bool point_of_thread(FluidScene scene, uint axis, out ivec3 at) {
  return listed_point_of_thread(scene, axis, at) &&
         (with_tiles == 0u || scene.tiles.at[0].visit_all == 0u || is_active_point(scene, axis, at));
}
