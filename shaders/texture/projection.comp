#version 460
#include "texture/layout.h"
#include "texture/projection.glsl"

// One thread a point: (u, v, face), or the weights of triplanar projection. Source: notes 6.3.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { PointMapArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  const vec3 p = args.inputs.at[i].xyz;
  const float turn = 0.5 + angle_of(p.x, -p.z) / (2.0 * half_turn);
  vec3 place = vec3(0.5 + 0.5 * p.x, 0.5 - 0.5 * p.y, 0.0);
  if (args.kind == 1u) place.x = turn;
  if (args.kind == 2u) place.xy = equirectangular_uv(p);
  if (args.kind == 3u) place = cube_place(p);
  if (args.kind == 4u) place = triplanar_weights(p);
  args.outputs.at[i] = vec4(place, 0.0);
}
