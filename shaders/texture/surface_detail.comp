#version 460
#include "texture/surface_detail.glsl"

// One thread a point of a surface: kind 0 bump, 1 normal map. Source: notes 6.3.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { SurfaceDetailArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  const SurfaceDetail d = args.details.at[i];
  vec3 n = bump(d.p_u, d.p_v, d.slope);
  if (args.kind == 1u) {
    n = bent_normal(d.normal / sqrt(dot(d.normal, d.normal)),
                    d.tangent.xyz / sqrt(dot(d.tangent.xyz, d.tangent.xyz)), d.tangent.w, d.texel,
                    d.scale);
    n /= sqrt(dot(n, n));
  }
  args.normals.at[i] = vec4(n, 0.0);
}
