#version 460
#include "shading/octahedral.glsl"

// Light of a row of texels times the nine polynomials of degree 0 to 2; one thread a row.
// Source: Ramamoorthi & Hanrahan 2001.
layout(local_size_x = 32) in;
layout(scalar, push_constant) uniform Push { HarmonicsArgs args; };

void main() {
  const uint row = gl_GlobalInvocationID.x;
  if (row >= args.side) return;
  vec4 sums[9];
  for (uint k = 0u; k < 9u; ++k) sums[k] = vec4(0.0);
  for (uint column = 0u; column < args.side; ++column) {
    const vec3 d = octahedral_direction((vec2(column, row) + 0.5) / float(args.side));
    const float length = abs(d.x) + abs(d.y) + abs(d.z);
    const float solid_angle = 4.0 * length * length * length / float(args.side * args.side);
    const vec4 light = args.level.at[(row + 1u) * (args.side + 2u) + column + 1u];
    const vec4 share = vec4(light.rgb, 1.0) * solid_angle;
    const float basis[9] = float[9](1.0, d.y, d.z, d.x, d.x * d.y, d.y * d.z, 3.0 * d.z * d.z - 1.0,
                                    d.x * d.z, d.x * d.x - d.y * d.y);
    for (uint k = 0u; k < 9u; ++k) sums[k] += basis[k] * share;
  }
  for (uint k = 0u; k < 9u; ++k) args.rows.at[row * 9u + k] = sums[k];
}
