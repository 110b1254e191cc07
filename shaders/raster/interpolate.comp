#version 460
#include "raster/layout.h"
#include "raster/barycentric.glsl"

// The varying of the triangle seen at a pixel's centre; one thread a pixel. Source: notes 1.6.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { InterpolateArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.width * args.height) return;
  const uint element = args.elements.at[i];
  if (element == 0u) {
    args.result.at[i] = vec4(0.0);
    return;
  }
  const uvec3 corners = args.source.triangles.at[element - args.source.first_element];
  const vec4 a = args.source.clip_positions.at[corners.x];
  const vec4 b = args.source.clip_positions.at[corners.y];
  const vec4 c = args.source.clip_positions.at[corners.z];
  const vec2 pixel = vec2(i % args.width, i / args.width) + 0.5;
  precise vec2 ndc = 2.0 * pixel / vec2(args.width, args.height) - 1.0;
  vec3 weights = perspective_barycentric(a, b, c, ndc);
  if (args.perspective == 0u) weights = linear_barycentric(weights, a, b, c);
  precise vec4 value = weights.x * args.varyings.at[corners.x] +
                       weights.y * args.varyings.at[corners.y] +
                       weights.z * args.varyings.at[corners.z];
  args.result.at[i] = value;
}
