#version 460
#include "shading/shadow_map.glsl"

// How much of the light reaches a point; one thread a point. Source: Reeves et al. 1987.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { ShadowArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  const vec4 point = args.points.at[i];
  const uint cascade = shadow_cascade(args.ends, point.w);
  if (cascade == 4u) {
    args.visibilities.at[i] = 1.0;
    return;
  }
  const mat4 m = args.shadow_from_world.at[cascade];
  precise const vec4 place = ((m[0] * point.x + m[1] * point.y) + m[2] * point.z) + m[3];
  precise const float depth = place.z - args.bias;
  args.visibilities.at[i] = shadow_filter(args.depths, cascade * args.side * args.side,
                                          int(args.side), place.xy, depth, int(args.radius));
}
