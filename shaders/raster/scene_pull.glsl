// What every vertex stage of the scene does: finds its vertex and says where it is.
#ifndef PARITY_RASTER_SCENE_PULL_GLSL
#define PARITY_RASTER_SCENE_PULL_GLSL
#include "raster/scene_layout.h"
#include "raster/scene_vertex.glsl"

layout(scalar, push_constant) uniform Push { SceneArgs args; };

// 0: gl_VertexIndex is a vertex of the first of args.draws. 1: it counts the corners of that draw.
// 2: it counts the corners of the elements in args.order. What is the same for all vertices is read
// from an address that is: software drivers then load it once, not for each.
layout(constant_id = 5) const uint pulling = 0u;
layout(constant_id = 6) const uint corners = 3u;  // of an element, when pulling in order

layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;

struct Pulled {
  SceneDraw draw;
  uint vertex;
  uint element;  // 1 + number; 0 unless corners are counted
};

Pulled pull_vertex() {
  uint d = 0u;
  uint vertex = gl_VertexIndex;
  if (pulling == 2u) {
    const uvec2 element = args.order.at[vertex / corners];
    d = element.x;
    vertex = element.y + vertex % corners;
  }
  SceneDraw draw = args.draws.at[d];
  uint element = 0u;
  if (pulling != 0u) {
    element = draw.first_element + vertex / draw.corners + 1u;
    vertex = draw.indices.at[vertex];
  }
  const vec3 p = draw.positions.at[vertex];
  position = vertex_position(draw, p);
  normal = vertex_normal(draw, vertex);
  gl_Position = clip_position(draw.clip_from_object, p);
  gl_PointSize = 1.0;
  return Pulled(draw, vertex, element);
}
#endif
