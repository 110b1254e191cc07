#version 460
#include "core/layout.h"

// Counts in loops of given lengths; one thread. A driver that cuts loops short counts too few.
layout(local_size_x = 1) in;
layout(scalar, push_constant) uniform Push { CanaryArgs args; };

void main() {
  uint single = 0;
  for (uint i = 0; i < args.single_count; ++i) single = single * 1664525u + 1013904223u;
  uint nested = 0;
  for (uint i = 0; i < args.nested_count; ++i)
    for (uint j = 0; j < args.nested_count; ++j) nested = nested * 1664525u + 1013904223u;
  args.results.at[0] = single;
  args.results.at[1] = nested;
}
