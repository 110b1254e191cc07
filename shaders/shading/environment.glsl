// Light from all around, prefiltered. Source: Karis 2013 (split sum); Ramamoorthi & Hanrahan 2001
// (spherical harmonics).
#ifndef PARITY_SHADING_ENVIRONMENT_GLSL
#define PARITY_SHADING_ENVIRONMENT_GLSL
#include "raster/scene_layout.h"
#include "shading/octahedral.glsl"

// What a mirror of that roughness shows.
vec3 mirrored(ref_SceneEnvironment environment, vec3 direction, float roughness) {
  const vec2 uv = octahedral_uv(direction);
  const float r = clamp(roughness, 0.0, 1.0);
  const float level = max(min(min((r - 0.045) / 0.055, 10.0 * r), 5.0 * r + 1.0), 0.0);
  const uint i = min(uint(level), mirror_level_count - 2u);
  const vec3 sharper = octahedral_texel(environment.at[0].mirrors, environment.at[0].begins[i],
                                        environment.at[0].sides[i], uv);
  const vec3 softer = octahedral_texel(environment.at[0].mirrors, environment.at[0].begins[i + 1u],
                                       environment.at[0].sides[i + 1u], uv);
  return mix(sharper, softer, level - float(i));
}

vec3 irradiance_by_harmonics(ref_SceneEnvironment e, vec3 n) {
  const vec3 sum = e.at[0].harmonics[0] + e.at[0].harmonics[1] * n.y + e.at[0].harmonics[2] * n.z +
                   e.at[0].harmonics[3] * n.x + e.at[0].harmonics[4] * (n.x * n.y) +
                   e.at[0].harmonics[5] * (n.y * n.z) +
                   e.at[0].harmonics[6] * (3.0 * n.z * n.z - 1.0) +
                   e.at[0].harmonics[7] * (n.x * n.z) +
                   e.at[0].harmonics[8] * (n.x * n.x - n.y * n.y);
  return max(sum, vec3(0.0));
}

// By a unit normal.
vec3 irradiance_over_pi(ref_SceneEnvironment e, vec3 n) {
  if (e.at[0].irradiance_side == 0u) return irradiance_by_harmonics(e, n);
  return octahedral_texel(e.at[0].irradiance, 0u, e.at[0].irradiance_side, octahedral_uv(n));
}
#endif
