#version 460
#include "core/layout.h"

// Adds one element, wherever it is told to read, to the first; one thread.
layout(local_size_x = 1) in;
layout(scalar, push_constant) uniform Push { TestPokeArgs args; };

void main() { args.values.at[0] = args.values.at[args.at] + args.value; }
