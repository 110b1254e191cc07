#version 460
#pragma no_contraction
#include "raster/scene_compute_layout.h"
#include "raster/scene_interpolate.glsl"
#include "raster/tile.glsl"

// Draws listed pixels anew with 16 samples; one thread a pixel. Each four samples that show one
// triangle, in the order of the quarters of the pixel, share a shade, taken in their middle. The
// triangles come from the list of the pixel's tile.
// Source: notes 1.7, 1.8.
layout(local_size_x = 64) in;
layout(constant_id = 11) const uint depth_mode = 1u;  // parity::DepthMode
layout(scalar, push_constant) uniform Push { RefineArgs args; };

const uint reverse_z = 1u, logarithmic = 2u;
const uint samples = 16u;
const bool has_unseen = cuts_out || blends;  // some item is masked or blended

// Sample s, in 1/16 pixel from the middle of the pixel: four in each quarter, all in columns and
// rows of their own (Chiu, Shirley & Wang 1994). The frame is moved by half of that unit, which
// these places lack.
ivec2 refined_place(uint s) {
  const uint quarter = s >> 2u, place = s & 3u;
  const ivec2 cell = 2 * ivec2(quarter & 1u, quarter >> 1u) + ivec2(place & 1u, place >> 1u);
  return 4 * cell + cell.yx - 8;
}

// The middle of some samples: inside of a triangle that covers them all.
vec2 middle_of(uint mask) {
  ivec2 sum = ivec2(0);
  [[unroll]] for (uint s = 0u; s < samples; ++s)
    if ((mask & (1u << s)) != 0u) sum += refined_place(s);
  return vec2(sum) / (16.0 * float(bitCount(mask)));
}

float stored_depth(SceneArgs scene, float plane) {
  precise float depth = plane;
  if (depth_mode == logarithmic)
    depth = -log2(scene.near * plane) / scene.log2_far_over_near;  // the plane is 1/w
  return clamp(depth, 0.0, 1.0);
}

struct Samples {
  vec4 color[samples];  // where has_unseen
  float depth[samples];
  uint element[samples];  // 1 + item
};

// Of equal depths the first in the scene wins.
bool is_in_front(Samples at, uint s, float depth, uint element) {
  if (depth == at.depth[s]) return element < at.element[s];
  return depth_mode == reverse_z ? depth > at.depth[s] : depth < at.depth[s];
}

// May a piece cover a place within half a pixel of a pixel's middle?
bool may_cover(TileTriangle t, ivec2 middle) {
  const ivec3 e = tile_edges(t, middle) + 8 * (abs(t.edge_x) + abs(t.edge_y));
  return (e.x | e.y | e.z) >= 0;
}

// Samples at which a piece is in front.
uint samples_behind(Samples at, SceneArgs scene, TileTriangle t, ivec2 middle) {
  uint mask = 0u;
  [[unroll]] for (uint s = 0u; s < samples; ++s) {
    const ivec2 place = middle + refined_place(s);
    const float depth = stored_depth(scene, tile_depth(t, place));
    const bool seen = tile_covers(t, place) && is_in_front(at, s, depth, t.element & ~element_unseen);
    mask |= seen ? 1u << s : 0u;
  }
  return mask;
}

void put_in_front(inout Samples at, SceneArgs scene, TileTriangle t, ivec2 middle, uint mask) {
  [[unroll]] for (uint s = 0u; s < samples; ++s) {
    if ((mask & (1u << s)) == 0u) continue;
    at.depth[s] = stored_depth(scene, tile_depth(t, middle + refined_place(s)));
    at.element[s] = t.element & ~element_unseen;
  }
}

// The first four of a mask's samples.
uint first_four(uint mask) {
  uint rest = mask;
  [[unroll]] for (uint i = 0u; i < 4u; ++i) rest &= rest - 1u;
  return mask & ~rest;
}

vec4 shade_item(SceneArgs scene, uint item, vec2 place) {
  const uvec2 name = args.items.at[item];
  SceneDraw draw = scene.draws.at[name.x];
  Corners corners;
  for (uint k = 0u; k < 3u; ++k) corners.clip[k] = args.clip_positions.at[3u * item + k];
  Fragment f = interpolate_at(corners, draw, name, place, vec2(args.width, args.height));
  f.pixel = uvec2(place);
  return shade_fragment(scene, draw.material, (draw.flags & draw_flag_unlit) != 0u, f);
}

bool is_blended(SceneArgs scene, uint item) {
  const uint material = scene.draws.at[args.items.at[item].x].material;
  return (scene.materials.at[material].flags & material_flag_blend) != 0u;
}

// All triangles that hide what is behind them.
void see_opaque(inout Samples at, SceneArgs scene, ivec2 middle, uint begin, uint end) {
  for (uint i = begin; i < end; ++i) {
    const TileTriangle t = args.tile_triangles.at[i];
    if ((t.element & element_unseen) != 0u || !may_cover(t, middle)) continue;
    const uint seen = samples_behind(at, scene, t, middle);
    if (seen != 0u) put_in_front(at, scene, t, middle, seen);
  }
}

uint samples_of(Samples at, uint element) {
  uint mask = 0u;
  [[unroll]] for (uint s = 0u; s < samples; ++s) mask |= at.element[s] == element ? 1u << s : 0u;
  return mask;
}

// First what is opaque, then, in the order of the tile's list, what masks cut and what is blended.
vec4 pixel_color(SceneArgs scene, uvec2 pixel, uint begin, uint end) {
  const ivec2 middle = tile_step(pixel % tile_side, ivec2(0));
  Samples at;
  [[unroll]] for (uint s = 0u; s < samples; ++s) {
    at.color[s] = args.background;
    at.depth[s] = depth_mode == reverse_z ? 0.0 : 1.0;
    at.element[s] = 0u;
  }
  see_opaque(at, scene, middle, begin, end);
  const uint uncovered = samples_of(at, 0u);
  vec4 sum = float(bitCount(uncovered)) * args.background;
  uint pending = ((1u << samples) - 1u) & ~uncovered;
  bool opaque = true;
  TileTriangle t;
  uint cursor = has_unseen ? begin : end;
  [[dont_unroll]] while (pending != 0u || cursor < end) {
    if (has_unseen && pending == 0u) {
      opaque = false;
      t = args.tile_triangles.at[cursor++];
      if ((t.element & element_unseen) == 0u || !may_cover(t, middle)) continue;
      pending = samples_behind(at, scene, t, middle);
      if (pending == 0u) continue;
    }
    const uint element = opaque ? at.element[findLSB(pending)] : t.element & ~element_unseen;
    const uint seen = first_four(opaque ? pending & samples_of(at, element) : pending);
    pending &= ~seen;
    const vec4 result = shade_item(scene, element - 1u, vec2(pixel) + 0.5 + middle_of(seen));
    sum += float(bitCount(seen)) * result;
    if (!has_unseen || result.a < 0.0) continue;
    const bool blended = !opaque && is_blended(scene, element - 1u);
    [[unroll]] for (uint s = 0u; s < samples; ++s) {
      if ((seen & (1u << s)) == 0u) continue;
      at.color[s] = blended ? vec4(result.rgb * result.a, result.a) + at.color[s] * (1.0 - result.a)
                            : result;
    }
    if (!opaque && !blended) put_in_front(at, scene, t, middle, seen);
  }
  if (has_unseen) {
    sum = vec4(0.0);
    [[unroll]] for (uint s = 0u; s < samples; ++s) sum += at.color[s];
  }
  return sum / float(samples);
}

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.pixel_count) return;
  SceneArgs scene = args.scene.at[0];
  const uint at = args.pixels.at[i];
  const uvec2 pixel = uvec2(at % args.width, at / args.width);
  const uint tile = (pixel.y / tile_side) * args.tiles_x + pixel.x / tile_side;
  const vec4 color = pixel_color(scene, pixel, args.begins.at[tile], args.begins.at[tile + 1u]);
  args.averages.at[2u * at] = packHalf2x16(color.rg);
  args.averages.at[2u * at + 1u] = packHalf2x16(color.ba);
}
