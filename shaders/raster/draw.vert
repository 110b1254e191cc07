#version 460
#include "raster/layout.h"

// Hands clip positions to the fixed-function pipeline; three vertices a triangle.
layout(scalar, push_constant) uniform Push { DrawArgs args; };
layout(location = 0) flat out uint element;
layout(location = 1) out vec4 perspective_varying;
layout(location = 2) noperspective out vec4 linear_varying;

void main() {
  const uint triangle = uint(gl_VertexIndex) / 3u;
  const uvec3 corners = args.triangles.at[triangle];
  const uint vertex = corners[uint(gl_VertexIndex) % 3u];
  gl_Position = args.clip_positions.at[vertex];
  element = args.first_element + triangle;
  perspective_varying = args.varyings.at[vertex];
  linear_varying = perspective_varying;
}
