#version 460
#include "texture/mip_pyramid.glsl"

// Three levels at once from codes whose sides are multiples of 8: a thread reads 8x8 texels and
// makes 4x4 of the next level, 2x2 of the one after it and one of the third, whose means it hands
// on. Source: notes 6.3.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { MipTripleArgs args; };

// The sum of two texels above each other.
vec4 pair(uint top, uint bottom) { return linear_texel(top) + linear_texel(bottom); }

void main() {
  const uint index = gl_GlobalInvocationID.x;
  const uint blocks = args.width / 8u;  // a row
  if (index >= blocks * (args.height / 8u)) return;
  const uvec2 block = uvec2(index % blocks, index / blocks);
  vec4 all = vec4(0.0);
  [[dont_unroll]] for (uint quarter = 0u; quarter < 4u; ++quarter) {
    const uvec2 at = 2u * block + uvec2(quarter & 1u, quarter >> 1);  // of 4x4 texels
    vec4 mean = vec4(0.0);
    [[dont_unroll]] for (uint half_row = 0u; half_row < 2u; ++half_row) {
      const uint row = 4u * at.y + 2u * half_row;
      const uvec4 top = args.codes_above.at[row * 2u * blocks + at.x];
      const uvec4 bottom = args.codes_above.at[(row + 1u) * 2u * blocks + at.x];
      const vec4 left = 0.25 * (pair(top.x, bottom.x) + pair(top.y, bottom.y));
      const vec4 right = 0.25 * (pair(top.z, bottom.z) + pair(top.w, bottom.w));
      args.codes.at[(2u * at.y + half_row) * 2u * blocks + at.x] =
          uvec2(stored_texel(left), stored_texel(right));
      mean += 0.25 * (left + right);
    }
    args.codes_second.at[at.y * 2u * blocks + at.x] = stored_texel(mean);
    all += 0.25 * mean;
  }
  args.codes_third.at[index] = stored_texel(all);
  args.means_third.at[index] = all;
}
