#version 460
#pragma no_contraction
#include "raster/scene_compute_layout.h"
#include "raster/scene_interpolate.glsl"
#include "raster/tile.glsl"

// Draws listed pixels anew with 16 samples, four at a time; one thread a pixel. A quarter's samples
// that show one triangle share a shade, taken at the first of them. The triangles come from the
// list of the pixel's tile.
// Source: notes 1.7, 1.8.
layout(local_size_x = 64) in;
layout(constant_id = 11) const uint depth_mode = 1u;  // parity::DepthMode
layout(scalar, push_constant) uniform Push { RefineArgs args; };

const uint reverse_z = 1u, logarithmic = 2u;
const uint quarter = 4u;

// Sample s of a group, in 1/16 pixel from the middle of the pixel: of the 4x4 samples that have 16
// columns and 16 rows (Chiu, Shirley & Wang 1994) those in one quarter of the pixel. The frame is
// moved by half of that unit, which these places lack. The first samples of the groups, where
// shades are taken, have the mean and the variance of the pixel.
ivec2 refined_place(uint group, uint s) {
  const uint first[4] = {1u, 3u, 0u, 2u};
  const uint place = s ^ first[group];
  const ivec2 cell = 2 * ivec2(group & 1u, group >> 1u) + ivec2(place & 1u, place >> 1u);
  return 4 * cell + cell.yx - 8;
}

float stored_depth(SceneArgs scene, float plane) {
  precise float depth = plane;
  if (depth_mode == logarithmic)
    depth = -log2(scene.near * plane) / scene.log2_far_over_near;  // the plane is 1/w
  return clamp(depth, 0.0, 1.0);
}

struct Quarter {
  vec4 color[quarter];
  float depth[quarter];
  uint element[quarter];  // 1 + item
};

// Of equal depths the first in the scene wins.
bool is_in_front(Quarter q, uint s, float depth, uint element) {
  if (depth == q.depth[s]) return element < q.element[s];
  return depth_mode == reverse_z ? depth > q.depth[s] : depth < q.depth[s];
}

// Samples at which a piece is in front, and its depths there.
uint samples_behind(Quarter q, SceneArgs scene, TileTriangle t, ivec2 steps[quarter],
                    out float depth[quarter]) {
  uint mask = 0u;
  [[unroll]] for (uint s = 0u; s < quarter; ++s) {
    depth[s] = stored_depth(scene, tile_depth(t, steps[s]));
    const bool seen =
        tile_covers(t, steps[s]) && is_in_front(q, s, depth[s], t.element & ~element_unseen);
    mask |= seen ? 1u << s : 0u;
  }
  return mask;
}

vec4 shade_item(SceneArgs scene, uint item, vec2 place) {
  const uvec2 name = args.items.at[item];
  SceneDraw draw = scene.draws.at[name.x];
  Corners corners;
  for (uint k = 0u; k < 3u; ++k) corners.clip[k] = args.clip_positions.at[3u * item + k];
  const Fragment f = interpolate_at(corners, draw, name, place, vec2(args.width, args.height));
  return shade_fragment(scene, draw.material, (draw.flags & draw_flag_unlit) != 0u, f);
}

bool is_blended(SceneArgs scene, uint item) {
  const uint material = scene.draws.at[args.items.at[item].x].material;
  return (scene.materials.at[material].flags & material_flag_blend) != 0u;
}

vec4 quarter_color(SceneArgs scene, uvec2 pixel, uint group, uint begin, uint end) {
  Quarter q;
  ivec2 steps[quarter];
  [[unroll]] for (uint s = 0u; s < quarter; ++s) {
    q.color[s] = args.background;
    q.depth[s] = depth_mode == reverse_z ? 0.0 : 1.0;
    q.element[s] = 0u;
    steps[s] = tile_step(pixel % tile_side, refined_place(group, s));
  }
  float depth[quarter];
  for (uint i = begin; i < end; ++i) {
    const TileTriangle t = args.tile_triangles.at[i];
    if ((t.element & element_unseen) != 0u) continue;
    const uint seen = samples_behind(q, scene, t, steps, depth);
    [[unroll]] for (uint s = 0u; s < quarter; ++s) {
      if ((seen & (1u << s)) == 0u) continue;
      q.depth[s] = depth[s];
      q.element[s] = t.element;
    }
  }
  uint pending = 0u;  // opaque and not shaded yet
  [[unroll]] for (uint s = 0u; s < quarter; ++s) pending |= q.element[s] != 0u ? 1u << s : 0u;
  uint cursor = args.has_unseen != 0u ? begin : end;
  [[dont_unroll]] while (pending != 0u || cursor < end) {
    const bool opaque = pending != 0u;
    uint element, seen = 0u;
    if (opaque) {
      element = q.element[findLSB(pending)];
      [[unroll]] for (uint s = 0u; s < quarter; ++s) seen |= q.element[s] == element ? 1u << s : 0u;
      pending &= ~seen;
    } else {
      const TileTriangle t = args.tile_triangles.at[cursor++];
      element = t.element & ~element_unseen;
      seen = t.element == element ? 0u : samples_behind(q, scene, t, steps, depth);
    }
    if (seen == 0u) continue;
    const vec2 place = vec2(pixel) + 0.5 + vec2(refined_place(group, uint(findLSB(seen)))) / 16.0;
    const vec4 result = shade_item(scene, element - 1u, place);
    if (result.a < 0.0) continue;
    const bool blended = !opaque && is_blended(scene, element - 1u);
    [[unroll]] for (uint s = 0u; s < quarter; ++s) {
      if ((seen & (1u << s)) == 0u) continue;
      q.color[s] = blended ? vec4(result.rgb * result.a, result.a) + q.color[s] * (1.0 - result.a)
                           : result;
      if (opaque || blended) continue;
      q.depth[s] = depth[s];
      q.element[s] = element;
    }
  }
  return 0.25 * ((q.color[0] + q.color[1]) + (q.color[2] + q.color[3]));
}

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.pixel_count) return;
  SceneArgs scene = args.scene.at[0];
  const uint at = args.pixels.at[i];
  const uvec2 pixel = uvec2(at % args.width, at / args.width);
  const uint tile = (pixel.y / tile_side) * args.tiles_x + pixel.x / tile_side;
  const uint begin = args.begins.at[tile], end = args.begins.at[tile + 1u];
  vec4 sum = vec4(0.0);
  [[dont_unroll]] for (uint group = 0u; group < 4u; ++group)
    sum += 0.25 * quarter_color(scene, pixel, group, begin, end);
  args.colors.at[at] = sum;
}
