#version 460
#include "shading/layout.h"

// Adds up the rows of one polynomial and turns radiance into irradiance over pi; one thread a
// polynomial. Source: Ramamoorthi & Hanrahan 2001: the cosine lobe keeps 1, 2/3 and 1/4 of degrees 0,
// 1 and 2.
layout(local_size_x = 16) in;
layout(scalar, push_constant) uniform Push { HarmonicsArgs args; };

void main() {
  const uint k = gl_GlobalInvocationID.x;
  if (k >= 9u) return;
  const float factors[9] = float[9](0.0795774715, 0.1591549431, 0.1591549431, 0.1591549431,
                                    0.2984155183, 0.2984155183, 0.0248679599, 0.2984155183,
                                    0.0746038796);
  vec3 sum = vec3(0.0);
  float sphere = 0.0;  // 4 pi but for the texels' midpoints
  for (uint row = 0u; row < args.side; ++row) {
    sum += args.rows.at[row * 9u + k].rgb;
    sphere += args.rows.at[row * 9u].w;
  }
  args.coefficients.at[k] = vec4(sum * (factors[k] * 12.5663706144 / sphere), 0.0);
}
