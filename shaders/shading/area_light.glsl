// Lights that have a size. Source: notes 6.1 (lights), 7; Lambert 1760; Baum et al. 1989; Karis 2013.
#ifndef PARITY_SHADING_AREA_LIGHT_GLSL
#define PARITY_SHADING_AREA_LIGHT_GLSL
#include "shading/microfacet.glsl"

// What one edge of a polygon, seen from the origin, adds to its irradiance on the plane z = 0: the
// angle that it subtends times the height of the normal of its plane.
float edge_irradiance(vec3 a, vec3 b) {
  const vec3 across = cross(a, b);
  const float sine = length(across);
  return sine > 0.0 ? across.z / sine * atan(sine, dot(a, b)) : 0.0;
}

// Irradiance of a convex quadrilateral of radiance 1 on the plane z = 0 at the origin. What is below
// the horizon is cut off: where the border enters or leaves, an edge along the horizon closes it, whose
// share is 0.5 of its angle.
float quadrilateral_irradiance(vec3 corner[4]) {
  float sum = 0.0;
  vec3 left = vec3(0.0);
  vec3 entered = vec3(0.0);
  bool crosses = false;
  for (uint i = 0u; i < 4u; ++i) {
    vec3 a = corner[i];
    vec3 b = corner[(i + 1u) & 3u];
    if (a.z < 0.0 && b.z < 0.0) continue;
    if (a.z < 0.0) {
      a = mix(a, b, a.z / (a.z - b.z));
      entered = vec3(a.xy, 0.0);
      crosses = true;
    } else if (b.z < 0.0) {
      b = mix(a, b, a.z / (a.z - b.z));
      left = vec3(b.xy, 0.0);
      crosses = true;
    }
    sum += edge_irradiance(a, b);
  }
  if (crosses) sum += edge_irradiance(left, entered);
  return 0.5 * abs(sum);
}

// Part of a sphere's radiance that a rough mirror (n = z, F = 1) sends to the eye: the point of the
// sphere nearest to the mirror direction stands for all of it, and the lobe is widened by the angle
// that the sphere fills. An approximation; its error is charted.
float sphere_highlight(vec3 center, float radius, vec3 v, float alpha) {
  const vec3 mirror = vec3(-v.x, -v.y, v.z);
  const float distance2 = dot(center, center);
  const vec3 to_ray = dot(center, mirror) * mirror - center;
  const float off = length(to_ray);
  const vec3 nearest = center + to_ray * min(radius / max(off, 1e-20), 1.0);
  const vec3 l = normalize(nearest);
  const float n_l = max(l.z, 0.0);
  if (!(n_l > 0.0)) return 0.0;
  const vec3 h = normalize(l + v);
  const float wide = min(alpha + radius / (2.0 * sqrt(distance2)), 1.0);
  const float narrowing = alpha / wide;
  const float d = ggx_distribution(dot(h.xy, h.xy) / (alpha * alpha), h.z, alpha * alpha);
  const float lobe = d * smith_visibility(n_l, v.z, alpha) * n_l * narrowing * narrowing;
  return lobe * pi * radius * radius / distance2;
}
#endif
