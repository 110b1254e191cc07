#version 460
#include "raster/bare_layout.h"

// One vertex of a mesh that stands where it was made.
layout(scalar, push_constant) uniform Push { BareArgs args; };

layout(location = 0) out vec3 position;
layout(location = 1) out vec3 normal;

void main() {
  position = args.positions.at[gl_VertexIndex];
  normal = args.normals.at[gl_VertexIndex];
  gl_Position = args.clip_from_object * vec4(position, 1.0);
}
