#version 460
#include "shading/brdf.glsl"

// The value of a BRDF; one thread a pair of directions. Source: notes 6.1, 6.2.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { BrdfArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  args.values.at[i] = brdf(args.queries.at[i], args.albedo_table);
}
