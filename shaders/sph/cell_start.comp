#version 460
#include "sph/layout.h"

// Where the particles of a cell begin: the number of smaller keys, by bisection of the sorted keys,
// first for rows, then inside them; one thread a row, and one for the end, then one a cell (x), row
// (y) and layer of rows (z). Source:
// Green 2010, but with no writes from several threads.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { CellStartArgs args; };

void main() {
  const bool first_only = args.rows == 0u;
  const uvec3 at = gl_GlobalInvocationID;
  const uint along = first_only ? 0u : at.x;
  const uint row = (first_only ? at.x : at.z * args.rows + at.y) * args.row;
  const uint cell = row + along;
  if (row > args.cell_count || (!first_only && (along == 0u || along >= args.row))) return;
  uint low = first_only ? 0u : args.starts.at[row];
  uint high = first_only ? args.count : args.starts.at[row + args.row];
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
