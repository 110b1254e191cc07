#version 460
#include "texture/layout.h"
#include "texture/environment.glsl"

// One thread a direction. Source: notes 6.3.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { EnvironmentArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  const vec3 d = args.directions.at[i].xyz;
  const ivec2 size = ivec2(args.width, args.height);
  args.colors.at[i] = args.cube != 0u ? sample_cube_map(args.texels, size.x, d)
                                      : sample_equirectangular(args.texels, size, d);
}
