#version 460
#include "shading/layout.h"
#include "shading/phong.glsl"

// A point of a lit triangle, shaded at the corners and interpolated (Gouraud), and shaded with the
// interpolated position and normal (Phong); one thread a point. Source: notes 6.1; Gouraud 1971; Phong
// 1975.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { GouraudArgs args; };

float radiance(GouraudQuery q, vec3 p, vec3 n) {
  const vec3 to_light = q.light - p;
  const float squared = dot(to_light, to_light);
  const vec3 l = to_light / sqrt(squared);
  const vec3 h = normalize(l + normalize(q.eye - p));
  const float diffuse = (1.0 - q.specular) * 0.31830988618;
  const float highlight = q.specular * blinn_phong_factor(q.exponent) * lobe(dot(n, h), q.exponent);
  return (diffuse + highlight) * max(dot(n, l), 0.0) / squared;
}

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  const GouraudQuery q = args.queries.at[i];
  vec3 p = vec3(0.0);
  vec3 n = vec3(0.0);
  float at_corners = 0.0;
  for (uint k = 0u; k < 3u; ++k) {
    p += q.place[k] * q.corners[k];
    n += q.place[k] * q.normals[k];
    at_corners += q.place[k] * radiance(q, q.corners[k], q.normals[k]);
  }
  args.radiances.at[i] = vec2(at_corners, radiance(q, p, normalize(n)));
}
