#version 460
#pragma no_contraction
#include "raster/scene_compute_layout.h"
#include "raster/scene_interpolate.glsl"
#include "raster/tile.glsl"

// Shades each distinct triangle that is seen at a sample of the pixel once, at the pixel's centre;
// then, in the order of the tile's list, what masks cut and what is blended; averages the samples.
// One thread a pixel, one workgroup a tile.
// Source: notes 1.7, 1.8; Vulkan 1.3, "Multisampling"; glTF 2.0, section 3.9.
layout(local_size_x = 8, local_size_y = 8) in;
layout(constant_id = 10) const uint samples = 8u;
layout(constant_id = 11) const uint depth_mode = 1u;  // parity::DepthMode
layout(scalar, push_constant) uniform Push { SceneShadeArgs args; };

const uint reverse_z = 1u;
const uint logarithmic = 2u;

float stored_depth(SceneArgs scene, float plane) {
  precise float depth = plane;
  if (depth_mode == logarithmic)
    depth = -log2(scene.near * plane) / scene.log2_far_over_near;  // the plane is 1/w
  return clamp(depth, 0.0, 1.0);
}

vec4 shade_item(SceneArgs scene, uint item, uvec2 pixel) {
  const uvec2 name = args.items.at[item];
  SceneDraw draw = scene.draws.at[name.x];
  Corners corners;
  for (uint k = 0u; k < 3u; ++k) corners.clip[k] = args.clip_positions.at[3u * item + k];
  Fragment f = interpolate(corners, draw, name, pixel, vec2(args.width, args.height));
  f.pixel = pixel;
  return shade_fragment(scene, draw.material, (draw.flags & draw_flag_unlit) != 0u, f);
}

// Number of an item's element through all draws, plus 1.
uint element_number(SceneArgs scene, uint item) {
  const uvec2 name = args.items.at[item];
  return scene.draws.at[name.x].first_element +
         (name.y & ~item_second_half) / scene.draws.at[name.x].corners + 1u;
}

bool is_blended(SceneArgs scene, uint item) {
  const uint material = scene.draws.at[args.items.at[item].x].material;
  return (scene.materials.at[material].flags & material_flag_blend) != 0u;
}

struct Samples {
  vec4 color[samples];
  float depth[samples];
  uint element[samples];  // 1 + item
};

// Whether a piece's depth wins at a sample; of equal depths the first in the scene does.
bool is_in_front(Samples at, uint s, float depth, uint element) {
  if (depth == at.depth[s]) return element < at.element[s];
  return depth_mode == reverse_z ? depth > at.depth[s] : depth < at.depth[s];
}

void load_samples(uint index, out Samples at) {
  for (uint s = 0u; s < samples; ++s) {
    at.color[s] = args.background;
    at.depth[s] = args.depths.at[index * samples + s];
    at.element[s] = args.elements.at[index * samples + s];
  }
}

// Samples that show an element, one bit each.
uint samples_of(Samples at, uint element) {
  uint mask = 0u;
  for (uint s = 0u; s < samples; ++s) mask |= at.element[s] == element ? 1u << s : 0u;
  return mask;
}

// Samples at which a piece is in front, and its depths there.
uint samples_behind(Samples at, SceneArgs scene, TileTriangle t, out float depth[samples]) {
  uint mask = 0u;
  for (uint s = 0u; s < samples; ++s) {
    const ivec2 place = tile_step(gl_LocalInvocationID.xy, sample_place(samples, s));
    depth[s] = stored_depth(scene, tile_depth(t, place));
    const bool seen = tile_covers(t, place) && is_in_front(at, s, depth[s], t.element & ~element_unseen);
    mask |= seen ? 1u << s : 0u;
  }
  return mask;
}

void main() {
  const uvec2 pixel = gl_GlobalInvocationID.xy;
  if (pixel.x >= args.width || pixel.y >= args.height) return;
  SceneArgs scene = args.scene.at[0];
  const uint index = pixel.y * args.width + pixel.x;
  Samples at;
  load_samples(index, at);
  uint pending = ((1u << samples) - 1u) & ~samples_of(at, 0u);  // opaque and not shaded yet
  const uint tile = gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x;
  uint cursor = args.begins.at[tile];
  const uint end = args.has_unseen != 0u ? args.begins.at[tile + 1u] : cursor;
  [[dont_unroll]] while (pending != 0u || cursor < end) {
    const bool opaque = pending != 0u;
    uint element;
    uint seen;
    float depth[samples];
    if (opaque) {
      element = at.element[findLSB(pending)];
      seen = samples_of(at, element);
      pending &= ~seen;
    } else {
      const TileTriangle t = args.tile_triangles.at[cursor++];
      element = t.element & ~element_unseen;
      seen = t.element == element ? 0u : samples_behind(at, scene, t, depth);
    }
    if (seen == 0u) continue;
    const vec4 result = shade_item(scene, element - 1u, pixel);
    if (result.a < 0.0) continue;
    const bool blended = !opaque && is_blended(scene, element - 1u);
    for (uint s = 0u; s < samples; ++s) {
      if ((seen & (1u << s)) == 0u) continue;
      at.color[s] = blended ? vec4(result.rgb * result.a, result.a) + at.color[s] * (1.0 - result.a)
                            : result;
      if (opaque || blended) continue;
      at.depth[s] = depth[s];
      at.element[s] = element;
    }
  }
  vec4 sum = vec4(0.0);
  for (uint s = 0u; s < samples; ++s) sum += at.color[s];
  args.out_color.at[index] = sum * (1.0 / float(samples));
  args.out_depth.at[index] = at.depth[0];
  args.out_element.at[index] = at.element[0] == 0u ? 0u : element_number(scene, at.element[0] - 1u);
}
