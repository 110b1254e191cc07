#version 460
#include "shading/area_light.glsl"
#include "shading/layout.h"

// Irradiance of a rectangle on a surface; one thread a point. Source: Lambert 1760; Baum et al. 1989.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { RectangleArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  const RectangleQuery q = args.queries.at[i];
  const vec3 helper = abs(q.normal.x) < 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
  const vec3 t = normalize(cross(helper, q.normal));
  const mat3 local = transpose(mat3(t, cross(q.normal, t), q.normal));
  vec3 corners[4];
  for (uint k = 0u; k < 4u; ++k) corners[k] = local * (q.corners[k] - q.point);
  args.irradiances.at[i] = quadrilateral_irradiance(corners);
}
