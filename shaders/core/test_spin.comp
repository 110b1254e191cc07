#version 460
#include "core/layout.h"

// Waits until the first element is `value`, which nobody writes; one thread.
layout(local_size_x = 1) in;
layout(scalar, push_constant) uniform Push { TestPokeArgs args; };

void main() {
  uint steps = 0;
  while (atomicAdd(args.values.at[0], 0u) != args.value) ++steps;
  args.values.at[1] = steps;
}
