#version 460
#include "shading/layout.h"
#include "shading/multi_scatter.glsl"

// Root of 1 less the mean albedo over the cosine-weighted hemisphere, 2 int E(c) c dc, of what the
// table gives: 256 midpoints of c^2. One thread a row. Source: Kulla & Conty 2017.
layout(local_size_x = 16) in;
layout(scalar, push_constant) uniform Push { AlbedoTableArgs args; };

void main() {
  const uint row = gl_GlobalInvocationID.x;
  if (row >= albedo_side) return;
  const float roughness = max(float(row) / float(albedo_side - 1u), 1.0 / 64.0);
  float sum = 0.0;
  for (uint i = 0u; i < 256u; ++i) {
    const float x = albedo_column(sqrt((float(i) + 0.5) / 256.0), roughness * roughness);
    const uint column = min(uint(x), albedo_side - 2u);
    const uint at = row * albedo_side + column;
    sum += mix(args.table.at[at].x, args.table.at[at + 1u].x, x - float(column));
  }
  const float root = sqrt(max(1.0 - sum / 256.0, 0.0));
  for (uint i = 0u; i < albedo_side; ++i) args.table.at[row * albedo_side + i].z = root;
}
