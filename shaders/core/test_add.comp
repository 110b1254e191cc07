#version 460
#include "core/layout.h"

// results[i] = values[i] + addend; one thread an element. The size of the workgroup can be set.
layout(local_size_x = 64, local_size_x_id = 0) in;
layout(scalar, push_constant) uniform Push { TestAddArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  args.results.at[i] = args.values.at[i] + args.addend;
}
