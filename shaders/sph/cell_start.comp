#version 460
#include "sph/layout.h"

// Where the particles of a cell begin: the number of smaller keys, by bisection of the sorted keys;
// one thread a cell, and one for the end. Source: Green 2010, but with no writes from several
// threads.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { CellStartArgs args; };

void main() {
  const uint cell = gl_GlobalInvocationID.x;
  if (cell > args.cell_count) return;
  uint low = 0u;
  uint high = args.count;
  for (int round = 0; round < 32 && low < high; ++round) {
    const uint middle = (low + high) / 2u;
    if (args.keys.at[middle] < cell) {
      low = middle + 1u;
    } else {
      high = middle;
    }
  }
  args.starts.at[cell] = low;
}
