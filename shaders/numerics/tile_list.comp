#version 460
#include "numerics/layout.h"
#include "numerics/tiles.glsl"

// From the flags of tiles to lists, by a prefix sum that always comes out the same; one workgroup,
// each thread has as many tiles in a row as any other. Source: Blelloch 1990.
layout(local_size_x = 256) in;
layout(scalar, push_constant) uniform Push { TileListArgs args; };

shared uvec3 counts[256];
shared uvec3 last_counts[256];

/// Workgroups for a number of threads.
void write_groups(TileTable table, uint at, uint threads) {
  const uint groups = (threads + 63u) / 64u;
  table.groups.at[at] = min(groups, group_row);
  table.groups.at[at + 1u] = (groups + group_row - 1u) / group_row;
  table.groups.at[at + 2u] = 1u;
}

void write_all_groups(TileTable table, uvec3 total, uvec3 last) {
  const uint volume = args.is_flat != 0u ? 32u : 128u;
  table.groups.at[0] = total.x;
  table.groups.at[1] = total.x + total.y;
  write_groups(table, tile_rows, 4u * total.x);
  write_groups(table, tile_quads, 16u * total.x);
  write_groups(table, tile_cells, volume * total.x);
  for (uint axis = 0u; axis < 3u; ++axis) {
    write_groups(table, tile_faces + 3u * axis, volume * total.x + tile_top * last[axis]);
    table.groups.at[last_tiles + axis] = last[axis];
  }
  write_groups(table, touched_cells, volume * (total.x + total.y));
  write_groups(table, left_cells, volume * total.y);
  write_groups(table, left_faces, (volume + tile_top) * total.y);
  table.groups.at[active_tiles] = total.z;
}

/// 1 where a tile is to be visited (x), was left (y), and is active (z).
uvec3 kind_of(TileTable table, uint tile) {
  const uint flags = table.flags.at[tile], now = flags & tile_active;
  return uvec3(table.visit_all | now, flags == tile_left ? 1u : 0u, now);
}

uvec3 place_of(uint tile) {
  return uvec3(tile % args.tiles.x, tile / args.tiles.x % args.tiles.y,
               tile / (args.tiles.x * args.tiles.y));
}

/// 1 for each axis along which no listed tile follows a listed one.
uvec3 is_last(TileTable table, uint tile) {
  const uvec3 place = place_of(tile), beside = uvec3(1u, args.tiles.x, args.tiles.x * args.tiles.y);
  uvec3 last = uvec3(0u);
  if (kind_of(table, tile).x != 0u)
    for (uint axis = 0u; axis < 3u; ++axis)
      last[axis] = place[axis] + 1u == args.tiles[axis] ? 1u : 1u - kind_of(table, tile + beside[axis]).x;
  return last;
}

void main() {
  if (args.clock.at[0] == 0.0) return;
  TileTable table = args.table.at[0];
  const uint id = gl_LocalInvocationID.x;
  const uint all = args.tiles.x * args.tiles.y * args.tiles.z;
  const uint chunk = (all + 255u) / 256u, begin = min(id * chunk, all), end = min(begin + chunk, all);
  counts[id] = last_counts[id] = uvec3(0u);
  for (uint t = begin; t < end; ++t) {
    counts[id] += kind_of(table, t);
    last_counts[id] += is_last(table, t);
  }
  barrier();
  uvec3 before = uvec3(0u), total = uvec3(0u), last_before = uvec3(0u), last_total = uvec3(0u);
  for (uint k = 0u; k < 256u; ++k) {
    if (k == id) before = total;
    if (k == id) last_before = last_total;
    total += counts[k];
    last_total += last_counts[k];
  }
  table.starts.at[id] = before.x;
  if (id == 0u) {
    table.starts.at[256] = total.x;
    write_all_groups(table, total, last_total);
  }
  uvec2 next = uvec2(before.x, total.x + before.y);
  uvec3 next_last = last_before + uvec3(2u, 3u, 4u) * table.room;
  for (uint t = begin; t < end; ++t) {
    const uvec3 kind = kind_of(table, t), last = is_last(table, t);
    const uint tile = packed(place_of(t));
    if (kind.x != 0u) table.list.at[next.x++] = tile;
    if (kind.y != 0u) table.list.at[next.y++] = tile;
    for (uint axis = 0u; axis < 3u; ++axis)
      if (last[axis] != 0u) table.list.at[next_last[axis]++] = tile;
  }
}
