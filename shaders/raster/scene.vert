#version 460
#pragma no_contraction
#include "raster/scene_pull.glsl"

// One vertex of the scene, pulled through references. Source: notes 2.6.
layout(constant_id = 1) const bool has_normal_maps = true;
layout(constant_id = 3) const uint uv_pair_count = 3u;
layout(constant_id = 7) const bool has_colors = true;

layout(location = 2) out vec4 tangent;
layout(location = 3) out vec4 color;
layout(location = 4) flat out uvec3 ids;  // material and flags of the draw; 1 + element; scale
layout(location = 5) out vec4 uv[3];

void main() {
  Pulled v = pull_vertex();
  ids.x = v.draw.material << draw_flag_bits | (v.draw.flags & ((1u << draw_flag_bits) - 1u));
  ids.y = v.element;
  ids.z = floatBitsToUint(v.draw.scale);
  tangent = has_normal_maps ? vertex_tangent(v.draw, v.vertex) : vec4(0.0);
  color = has_colors ? vertex_color(v.draw, v.vertex) : vec4(1.0);
  uv[0] = uv_pair_count > 0u ? vertex_uv_pair(v.draw, 0u, v.vertex) : vec4(0.0);
  uv[1] = uv_pair_count > 1u ? vertex_uv_pair(v.draw, 1u, v.vertex) : vec4(0.0);
  uv[2] = uv_pair_count > 2u ? vertex_uv_pair(v.draw, 2u, v.vertex) : vec4(0.0);
}
