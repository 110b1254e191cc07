#version 460
#pragma no_contraction
#include "raster/scene_compute_layout.h"
#include "raster/scene_vertex.glsl"

// Clip positions and flags of one triangle of the scene; lines and points become rectangles of one
// pixel's width. Source: notes 1.1, 2.6; Vulkan 1.3, "Line Segment Rasterization".
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { SceneTriangleArgs args; };

// Half a pixel to the side of the segment, in clip space of a point of weight 1.
vec2 half_width(vec4 a, vec4 b) {
  const vec2 size = vec2(args.width, args.height);
  const vec2 along = (b.xy / b.w - a.xy / a.w) * size;
  const float squared = dot(along, along);
  if (!(squared > 0.0)) return vec2(0.0);
  return vec2(-along.y, along.x) / sqrt(squared) / size;
}

// The end of the segment from a to b that is moved up to the near plane if it lies before it.
vec4 behind_near(vec4 a, vec4 b) {
  return a.z < 0.0 && b.z > 0.0 ? a + (b - a) * (a.z / (a.z - b.z)) : a;
}

void write_line(uint item, vec4 begin, vec4 end, bool second) {
  const vec4 a = behind_near(begin, end);
  const vec4 b = behind_near(end, begin);
  const bool usable = a.w > 0.0 && b.w > 0.0;
  const vec2 side = usable ? half_width(a, b) : vec2(0.0);
  args.clip_positions.at[3u * item] = usable ? vec4(a.xy + side * a.w, a.zw) : vec4(0.0);
  args.clip_positions.at[3u * item + 1u] =
      second ? vec4(b.xy - side * b.w, b.zw) : vec4(a.xy - side * a.w, a.zw);
  args.clip_positions.at[3u * item + 2u] =
      second ? vec4(b.xy + side * b.w, b.zw) : vec4(b.xy - side * b.w, b.zw);
}

void write_point(uint item, vec4 p, bool second) {
  const vec2 r = p.w / vec2(args.width, args.height);
  args.clip_positions.at[3u * item] = vec4(p.xy - r, p.zw);
  args.clip_positions.at[3u * item + 1u] = vec4(p.xy + (second ? r : vec2(r.x, -r.y)), p.zw);
  args.clip_positions.at[3u * item + 2u] = vec4(p.xy + (second ? vec2(-r.x, r.y) : r), p.zw);
}

void main() {
  const uint item = gl_GlobalInvocationID.x;
  if (item >= args.count) return;
  const uvec2 name = args.items.at[item];
  const uint first = name.y & ~item_second_half;
  SceneDraw draw = args.scene.at[0].draws.at[name.x];
  vec4 clip[3];
  for (uint k = 0u; k < draw.corners; ++k) {
    clip[k] = clip_position(draw.clip_from_object, draw.positions.at[draw.indices.at[first + k]]);
    args.clip_positions.at[3u * item + k] = clip[k];
  }
  if (draw.corners == 2u) write_line(item, clip[0], clip[1], first != name.y);
  if (draw.corners == 1u) write_point(item, clip[0], first != name.y);
  args.triangles.at[item] = uvec3(3u * item, 3u * item + 1u, 3u * item + 2u);

  const uint material = args.scene.at[0].materials.at[draw.material].flags;
  uint flags = (draw.flags & draw_flag_mirrored) != 0u ? triangle_mirrored : 0u;
  if ((material & material_flag_double_sided) == 0u && draw.corners == 3u) flags |= triangle_cull_back;
  if ((material & (material_flag_mask | material_flag_blend)) != 0u) flags |= triangle_unseen;
  args.flags.at[item] = flags;
}
