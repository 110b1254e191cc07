#version 460
#include "core/layout.h"

// Passes on position and colour of the vertex.
layout(scalar, push_constant) uniform Push { TestTriangleArgs args; };
layout(location = 0) out vec4 color;

void main() {
  gl_Position = args.positions.at[gl_VertexIndex];
  gl_PointSize = 1;
  color = args.colors.at[gl_VertexIndex + gl_InstanceIndex];
}
