#version 460
#include "shading/octahedral.glsl"

// Irradiance over pi by normal: the mean of the light of all texels, each by its solid angle and its
// cosine to the normal; one thread a normal.
layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar, push_constant) uniform Push { IrradianceArgs args; };

void main() {
  const uvec2 pixel = gl_GlobalInvocationID.xy;
  if (pixel.x >= args.side || pixel.y >= args.side) return;
  const vec3 n = octahedral_direction((vec2(pixel) + 0.5) / float(args.side));
  vec4 sum = vec4(0.0);
  for (uint row = 0u; row < args.level_side; ++row) {
    vec4 part = vec4(0.0);
    for (uint column = 0u; column < args.level_side; ++column) {
      const vec3 d = octahedral_direction((vec2(column, row) + 0.5) / float(args.level_side));
      const float length = abs(d.x) + abs(d.y) + abs(d.z);
      const float weight = max(dot(n, d), 0.0) * (length * length * length);
      const vec4 light = args.level.at[(row + 1u) * (args.level_side + 2u) + column + 1u];
      part += weight * vec4(light.rgb, 1.0);
    }
    sum += part;
  }
  args.irradiance.at[pixel.y * args.side + pixel.x] = vec4(sum.rgb / sum.w, 1.0);
}
