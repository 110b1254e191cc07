#version 460
#include "core/layout.h"

// Writes one element, wherever it is told to; one thread.
layout(local_size_x = 1) in;
layout(scalar, push_constant) uniform Push { TestPokeArgs args; };

void main() { args.values.at[args.at] = args.value; }
