#version 460
#include "numerics/layout.h"
#include "numerics/tiles.glsl"

// From the flags of tiles to lists, by a prefix sum that always comes out the same; one workgroup,
// each thread has as many tiles in a row as any other. Source: Blelloch 1990.
layout(local_size_x = 256) in;
layout(scalar, push_constant) uniform Push { TileListArgs args; };

shared uvec3 counts[256];

void write_groups(TileTable table, uint at, uint x, uint y) {
  table.groups.at[at] = x;
  table.groups.at[at + 1u] = y;
  table.groups.at[at + 2u] = 1u;
}

/// Workgroups of 64 threads: tile_dispatch of the layout.
void write_all_groups(TileTable table, uint listed, uint touched) {
  const uint cells = args.is_flat != 0u ? 1u : 2u, faces = args.is_flat != 0u ? 1u : 3u;
  table.groups.at[0] = listed;
  table.groups.at[1] = touched;
  write_groups(table, tile_rows, (listed + 15u) / 16u, 1u);
  write_groups(table, tile_quads, (listed + 3u) / 4u, 1u);
  write_groups(table, tile_cells, listed, cells);
  write_groups(table, tile_faces, listed, faces);
  write_groups(table, touched_cells, touched, cells);
  write_groups(table, left_cells, touched - listed, cells);
  write_groups(table, left_faces, touched - listed, faces);
}

/// 1 where a tile is to be visited (x), was left (y), and is active (z).
uvec3 kind_of(TileTable table, uint tile) {
  const uint flags = table.flags.at[tile], now = flags & tile_active;
  return uvec3(table.visit_all | now, flags == tile_left ? 1u : 0u, now);
}

void main() {
  if (args.clock.at[0] == 0.0) return;
  TileTable table = args.table.at[0];
  const uint id = gl_LocalInvocationID.x;
  const uint all = args.tiles.x * args.tiles.y * args.tiles.z;
  const uint chunk = (all + 255u) / 256u, begin = min(id * chunk, all), end = min(begin + chunk, all);
  uvec3 own = uvec3(0u);
  for (uint t = begin; t < end; ++t) own += kind_of(table, t);
  counts[id] = own;
  barrier();
  uvec3 before = uvec3(0u), total = uvec3(0u);
  for (uint k = 0u; k < 256u; ++k) {
    if (k == id) before = total;
    total += counts[k];
  }
  table.starts.at[id] = before.x;
  if (id == 0u) {
    table.starts.at[256] = total.x;
    write_all_groups(table, total.x, total.x + total.y);
    table.groups.at[active_tiles] = total.z;
  }
  uvec2 next = uvec2(before.x, total.x + before.y);
  for (uint t = begin; t < end; ++t) {
    const uvec3 kind = kind_of(table, t);
    const uvec3 tile = uvec3(t % args.tiles.x, t / args.tiles.x % args.tiles.y,
                             t / (args.tiles.x * args.tiles.y));
    if (kind.x != 0u) table.list.at[next.x++] = packed(tile);
    if (kind.y != 0u) table.list.at[next.y++] = packed(tile);
  }
}
