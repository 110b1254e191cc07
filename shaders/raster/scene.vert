#version 460
#include "raster/scene_layout.h"
#include "raster/scene_vertex.glsl"

// One vertex of the scene, pulled through references. Source: notes 2.6.
layout(scalar, push_constant) uniform Push { SceneArgs args; };

layout(constant_id = 1) const bool has_normal_maps = true;
layout(constant_id = 3) const uint uv_pair_count = 3u;
// 0: gl_VertexIndex is a vertex of draw gl_InstanceIndex. 1: it counts the corners of that draw.
// 2: it counts the corners of the elements in args.order.
layout(constant_id = 5) const uint pulling = 0u;
layout(constant_id = 6) const uint corners = 3u;  // of an element, when pulling in order
layout(constant_id = 7) const bool has_colors = true;

layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;
layout(location = 2) out vec4 tangent;
layout(location = 3) out vec4 color;
layout(location = 4) flat out uvec2 ids;  // material and flags of the draw; 1 + element
layout(location = 5) out vec4 uv[3];

void main() {
  uint d = gl_InstanceIndex;
  uint vertex = gl_VertexIndex;
  if (pulling == 2u) {
    const uvec2 element = args.order.at[vertex / corners];
    d = element.x;
    vertex = element.y + vertex % corners;
  }
  SceneDraw draw = args.draws.at[d];
  ids = uvec2(draw.material << 2 | (draw.flags & (draw_flag_mirrored | draw_flag_unlit)), 0u);
  if (pulling != 0u) {
    ids.y = draw.first_element + vertex / draw.corners + 1u;
    vertex = draw.indices.at[vertex];
  }
  const vec3 p = draw.positions.at[vertex];
  position = vertex_position(draw, p);
  normal = vertex_normal(draw, vertex);
  tangent = has_normal_maps ? vertex_tangent(draw, vertex) : vec4(0.0);
  color = has_colors ? vertex_color(draw, vertex) : vec4(1.0);
  uv[0] = uv_pair_count > 0u ? vertex_uv_pair(draw, 0u, vertex) : vec4(0.0);
  uv[1] = uv_pair_count > 1u ? vertex_uv_pair(draw, 1u, vertex) : vec4(0.0);
  uv[2] = uv_pair_count > 2u ? vertex_uv_pair(draw, 2u, vertex) : vec4(0.0);
  gl_Position = clip_position(draw.clip_from_object, p);
  gl_PointSize = 1.0;
}
