#version 460
#include "raster/tile.glsl"

// Tests the samples of a tile against its list, in order. A thread holds `held` samples of a run of
// pixels in registers: 64 / (held / samples) threads a tile, whole tiles a workgroup.
// Source: notes 1.4, 1.7; Pineda 1988.
layout(local_size_x = 64) in;
layout(constant_id = 0) const uint samples = 1u;
layout(constant_id = 1) const uint depth_mode = 0u;  // parity::DepthMode
layout(constant_id = 2) const uint counts_only = 0u;
layout(constant_id = 3) const uint held = 8u;  // samples times 1, 2, 4, 8, 16, 32 or 64
layout(scalar, push_constant) uniform Push { TileRasterArgs args; };

const uint reverse_z = 1u, logarithmic = 2u;

/// Pixel of a held sample from the first of the thread: part of a row, or whole rows.
uvec2 pixel_of(uint k) { return uvec2(k / samples % tile_side, k / samples / tile_side); }

/// Depth in the convention of the mode, from what the plane gives.
float stored_depth(float plane) {
  precise float depth = plane;
  if (depth_mode == logarithmic) depth = args.log_scale * log2(args.log_near * plane);
  return clamp(depth, 0.0, 1.0);
}

bool is_in_front(float depth, float than) {
  return depth_mode == reverse_z ? depth > than : depth < than;
}

void main() {
  const uint run = held / samples;
  const uint threads = tile_side * tile_side / run;  // of a tile
  const uint tile = gl_GlobalInvocationID.x / threads;
  if (tile >= args.tile_count) return;
  const uint first = (gl_GlobalInvocationID.x % threads) * run;
  const uvec2 pixel = uvec2(first % tile_side, first / tile_side);
  const ivec2 start = tile_step(pixel, ivec2(0));

  float depth[held];
  uint element[held];
  [[unroll]] for (uint k = 0u; k < held; ++k) {
    depth[k] = depth_mode == reverse_z ? 0.0 : 1.0;
    element[k] = 0u;
  }
  uint count[held];
  [[unroll]] for (uint k = 0u; k < held; ++k) count[k] = 0u;

  const uint last = args.begins.at[tile + 1u];
  for (uint i = args.begins.at[tile]; i < last; ++i) {
    const TileTriangle t = args.triangles.at[i];
    const ivec3 edges = tile_edges(t, start);
    [[unroll]] for (uint k = 0u; k < held; ++k) {
      // The offset is known to the compiler: no products by variables.
      const ivec2 offset = 16 * ivec2(pixel_of(k)) + sample_place(samples, k % samples);
      const bool covered = is_shown(edges + t.edge_x * offset.x + t.edge_y * offset.y, t.element);
      if (counts_only != 0u) {
        count[k] += covered ? 1u : 0u;
        element[k] = covered ? t.element : element[k];
      } else {
        const float z = stored_depth(tile_depth(t, start + offset));
        const bool seen = covered && is_in_front(z, depth[k]);
        depth[k] = seen ? z : depth[k];
        element[k] = seen ? t.element : element[k];
      }
    }
  }

  const uvec2 corner = uvec2(tile % args.tiles_x, tile / args.tiles_x) * tile_side + pixel;
  [[unroll]] for (uint k = 0u; k < held; ++k) {
    const uvec2 at_pixel = corner + pixel_of(k);
    if (at_pixel.x >= args.width || at_pixel.y >= args.height) continue;
    const uint at = (at_pixel.y * args.width + at_pixel.x) * samples + k % samples;
    args.elements.at[at] = element[k];
    if (counts_only != 0u)
      args.counts.at[at] = count[k];
    else
      args.depths.at[at] = depth[k];
  }
}
