#version 460
#include "texture/perlin_noise.glsl"

// One thread a point. Source: notes 6.3.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { PointMapArgs args; };

float value_at(vec3 p) {
  if (args.kind == 0u) return perlin_noise(args.permutation, p);
  if (args.kind == 3u) return worley_noise(args.permutation, p);
  if (args.kind == 4u) return marble(args.permutation, p);
  if (args.kind == 5u) return wood(args.permutation, p);
  return noise_octaves(args.permutation, p, args.kind == 2u);
}

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  args.outputs.at[i] = vec4(value_at(args.inputs.at[i].xyz), 0.0, 0.0, 0.0);
}
