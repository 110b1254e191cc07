#version 460
#include "shading/area_light.glsl"
#include "shading/layout.h"

// The image of a sphere in a rough mirror; one thread a view. Source: Karis 2013.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { SphereArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  const SphereQuery q = args.queries.at[i];
  args.radiances.at[i] = sphere_highlight(q.center, q.radius, q.to_eye, q.alpha);
}
