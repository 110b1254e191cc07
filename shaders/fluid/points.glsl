// Which point of a field a thread is for. Needs fluid/grid.glsl and numerics/tiles.glsl.

uvec3 tile_size(uvec3 cells) { return uvec3(tile_x, tile_yz, min(cells.z, tile_yz)); }

/// Point `slot` of the k-th listed tile: its cells, or the faces across `axis` below its cells and,
/// where no listed tile follows, those above the last. False: there is none.
bool listed_point_of_slot(FluidScene scene, uint axis, uint k, uint slot, out ivec3 at) {
  TileTable table = scene.tiles.at[0];
  const uvec3 side = tile_size(scene.cells), tile = tile_at(table.list.at[k]);
  const uvec3 corner = tile_side * tile;
  const uint volume = side.x * side.y * side.z;
  uvec3 point;
  if (slot < volume) {
    point = corner + uvec3(slot % side.x, slot / side.x % side.y, slot / (side.x * side.y));
    at = ivec3(point);
    return all(lessThan(point, scene.cells));
  }
  if (axis > 2u) return false;
  const uint a = (axis + 1u) % 3u, b = (axis + 2u) % 3u, s = slot - volume;
  point[axis] = min(corner[axis] + side[axis], scene.cells[axis]);
  point[a] = corner[a] + s % side[a];
  point[b] = corner[b] + s / side[a];
  at = ivec3(point);
  if (s >= side[a] * side[b] || point[a] >= scene.cells[a] || point[b] >= scene.cells[b]) return false;
  return !is_listed(table, scene.cells, tile + uvec3(unit(axis)));
}

/// Without tiles: points in the order of the field. With: 64 points of a tile a workgroup, active or
/// not.
bool listed_point_of_thread(FluidScene scene, uint axis, out ivec3 at) {
  if (with_tiles != 0u)
    return listed_point_of_slot(scene, axis, gl_WorkGroupID.x,
                                gl_WorkGroupID.y * 64u + gl_LocalInvocationID.x, at);
  const ivec3 size = points_of(scene.cells, axis);
  at = point_of(size, gl_GlobalInvocationID.x);
  return gl_GlobalInvocationID.x < point_count(size);
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
