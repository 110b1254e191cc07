#version 460
#include "raster/tile.glsl"

// Tests the samples of a tile against its list, in order. A thread holds `held` samples of a run of
// pixels in registers: 64 / (held / samples) threads a tile, whole tiles a workgroup.
// Source: notes 1.4, 1.7; Pineda 1988.
layout(local_size_x = 64) in;
layout(constant_id = 0) const uint samples = 1u;
layout(constant_id = 1) const uint depth_mode = 0u;  // parity::DepthMode
layout(constant_id = 2) const uint counts_only = 0u;
layout(constant_id = 3) const uint held = 8u;  // a multiple of samples, at most 8 pixels
layout(scalar, push_constant) uniform Push { TileRasterArgs args; };

const uint reverse_z = 1u, logarithmic = 2u;

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
    [[unroll]] for (uint k = 0u; k < held; ++k) {
      const ivec2 at = tile_step(pixel + uvec2(k / samples, 0), sample_place(samples, k % samples));
      const bool covered = tile_shows(t, at);
      if (counts_only != 0u) {
        count[k] += covered ? 1u : 0u;
        element[k] = covered ? t.element : element[k];
      } else {
        const float z = stored_depth(tile_depth(t, at));
        const bool seen = covered && is_in_front(z, depth[k]);
        depth[k] = seen ? z : depth[k];
        element[k] = seen ? t.element : element[k];
      }
    }
  }

  const uvec2 corner = uvec2(tile % args.tiles_x, tile / args.tiles_x) * tile_side + pixel;
  [[unroll]] for (uint k = 0u; k < held; ++k) {
    const uint x = corner.x + k / samples;
    if (x >= args.width || corner.y >= args.height) continue;
    const uint at = (corner.y * args.width + x) * samples + k % samples;
    args.elements.at[at] = element[k];
    if (counts_only != 0u)
      args.counts.at[at] = count[k];
    else
      args.depths.at[at] = depth[k];
  }
}
