// How much of a directional light reaches a point, by shadow maps. Source: notes 6.1; Williams 1978;
// Reeves et al. 1987 (percentage-closer filtering); Zhang et al. 2006 (cascades).
#ifndef PARITY_SHADING_SHADOW_MAP_GLSL
#define PARITY_SHADING_SHADOW_MAP_GLSL
#include "shading/layout.h"

// Share of a box of 2 radius + 1 texels around a place whose depth does not hide the receiver; the
// texels at its rim count in part. Outside of the map nothing hides.
float shadow_filter(ref_float depths, uint first, int side, vec2 place, float depth, int radius) {
  precise const vec2 at = place * float(side) - 0.5;
  const vec2 low = floor(at);
  const vec2 part = at - low;
  float sum = 0.0;
  bool all = true;
  for (int j = -radius; j <= radius + 1; ++j) {
    const float weight_y = j == -radius ? 1.0 - part.y : (j == radius + 1 ? part.y : 1.0);
    for (int i = -radius; i <= radius + 1; ++i) {
      const float weight_x = i == -radius ? 1.0 - part.x : (i == radius + 1 ? part.x : 1.0);
      const vec2 texel = low + vec2(i, j);
      const bool inside = min(texel.x, texel.y) >= 0.0 && max(texel.x, texel.y) < float(side);
      bool lit = true;
      if (inside) lit = depth <= depths.at[first + uint(texel.y) * uint(side) + uint(texel.x)];
      if (lit) sum += weight_x * weight_y;
      all = all && lit;
    }
  }
  const float width = float(2 * radius + 1);
  return all ? 1.0 : sum / (width * width);  // weights need not add up to all exactly
}

// The first cascade that reaches that far; 4: none.
uint shadow_cascade(vec4 ends, float distance) {
  for (uint k = 0u; k < 4u; ++k)
    if (distance <= ends[k]) return k;
  return 4u;
}
#endif
