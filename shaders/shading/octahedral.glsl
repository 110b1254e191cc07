// Directions and the unit square. Source: Engelhardt & Dachsbacher 2008, "Octahedron Environment Maps".
#ifndef PARITY_SHADING_OCTAHEDRAL_GLSL
#define PARITY_SHADING_OCTAHEDRAL_GLSL
#include "shading/layout.h"

// 0 to 1; (0.5, 0.5) is +z.
vec2 octahedral_uv(vec3 d) {
  const vec3 size = abs(d);
  vec2 p = d.xy / (size.x + size.y + size.z);
  if (d.z < 0.0) p = (1.0 - abs(p.yx)) * vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
  return 0.5 * p + 0.5;
}

// Between four texels of a level with a border of one texel.
vec3 octahedral_texel(ref_vec4 texels, uint first, uint side, vec2 uv) {
  const vec2 at = clamp(uv * float(side) + 0.5, vec2(0.0), vec2(float(side + 1u)));
  const uint i = min(uint(at.x), side);
  const uint j = min(uint(at.y), side);
  const uint k = first + j * (side + 2u) + i;
  const vec2 t = at - vec2(i, j);
  return mix(mix(texels.at[k].rgb, texels.at[k + 1u].rgb, t.x),
             mix(texels.at[k + side + 2u].rgb, texels.at[k + side + 3u].rgb, t.x), t.y);
}

vec3 octahedral_direction(vec2 uv) {
  vec2 p = 2.0 * uv - 1.0;
  const float z = 1.0 - abs(p.x) - abs(p.y);
  if (z < 0.0) p = (1.0 - abs(p.yx)) * vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
  return normalize(vec3(p, z));
}
#endif
