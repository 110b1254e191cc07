#version 460
#include "raster/layout.h"

// The varying as the device interpolates it. Source: notes 1.6.
layout(scalar, push_constant) uniform Push { DrawArgs args; };
layout(location = 1) in vec4 perspective_varying;
layout(location = 2) noperspective in vec4 linear_varying;
layout(location = 0) out vec4 value;

void main() { value = args.perspective != 0u ? perspective_varying : linear_varying; }
