#version 460
#include "texture/mip_pyramid.glsl"

// One level from the one above, of any size; one thread a texel. Means that were not rounded are
// handed on. Source: notes 6.3.
layout(local_size_x = 64) in;
layout(constant_id = 1) const bool from_codes = true;  // else from means
layout(scalar, push_constant) uniform Push { MipLevelArgs args; };

vec4 above(uint index) {
  return from_codes ? linear_texel(args.codes_above.at[index]) : args.means_above.at[index];
}

void main() {
  const uint index = gl_GlobalInvocationID.x;
  if (index >= args.width * args.height) return;
  const Taps across = box_taps(index % args.width, args.width_above, args.width);
  const Taps down = box_taps(index / args.width, args.height_above, args.height);
  vec4 sum = vec4(0.0);
  [[dont_unroll]] for (uint j = 0u; j < 3u; ++j) {
    [[dont_unroll]] for (uint i = 0u; i < 3u; ++i) {
      const float weight = across.weight[i] * down.weight[j];
      if (weight == 0.0) continue;
      sum += weight * above((down.first + j) * args.width_above + across.first + i);
    }
  }
  args.codes.at[index] = stored_texel(sum);
  args.means.at[index] = sum;
}
