#version 460
#include "texture/mip_pyramid.glsl"

// Two levels at once from codes whose sides are multiples of 4: a thread reads 4x4 texels and makes
// 2x2 of the next level and one of the level after it. Source: notes 6.3.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { MipPairArgs args; };

void main() {
  const uint index = gl_GlobalInvocationID.x;
  const uint blocks = args.width / 4u;  // a row
  if (index >= blocks * (args.height / 4u)) return;
  const uint x = index % blocks;
  const uint y = index / blocks;
  vec4 mean = vec4(0.0);
  [[dont_unroll]] for (uint half_row = 0u; half_row < 2u; ++half_row) {
    const uint row = 4u * y + 2u * half_row;
    const uvec4 top = args.codes_above.at[row * blocks + x];
    const uvec4 bottom = args.codes_above.at[(row + 1u) * blocks + x];
    const vec4 left = 0.25 * (linear_texel(top.x) + linear_texel(top.y) + linear_texel(bottom.x) +
                              linear_texel(bottom.y));
    const vec4 right = 0.25 * (linear_texel(top.z) + linear_texel(top.w) + linear_texel(bottom.z) +
                               linear_texel(bottom.w));
    args.codes.at[(2u * y + half_row) * blocks + x] = uvec2(stored_texel(left), stored_texel(right));
    mean += 0.25 * (left + right);
  }
  args.codes_below.at[index] = stored_texel(mean);
  args.means_below.at[index] = mean;
}
