#version 460
#include "sampling/pattern.glsl"

// One thread a sample of the pattern. Source: notes 1.8.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { PatternArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  args.samples.at[i] = pattern_sample(args.pattern, i, args.count, args.columns, args.seed);
}
