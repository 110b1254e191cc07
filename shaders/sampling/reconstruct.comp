#version 460
#include "sampling/filter.glsl"

// Resamples lines of texels by a filter as wide as the coarser of the two grids; one thread a texel
// that comes out. Beyond the border the line goes on with its last texel. Source: notes 1.8.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { ReconstructArgs args; };

void main() {
  const uvec2 at = args.lines_first != 0u ? gl_GlobalInvocationID.xy : gl_GlobalInvocationID.yx;
  if (at.x >= args.lines || at.y >= args.out_count) return;
  // Places in halves of a texel of either grid are whole numbers: texel i that comes out is
  // (2 i + 1) in_count / out_count halves of a texel of `from` along the line.
  const int from_count = int(args.in_count), to_count = int(args.out_count);
  const int middle = (2 * int(at.y) + 1) * from_count;
  const int unit = 2 * max(from_count, to_count);
  const int reach = int(filter_reach(args.filter_kind) * float(unit));
  const int low = middle - reach - to_count;
  const int first = low > 0 ? (low - 1) / (2 * to_count) + 1 : -(-low / (2 * to_count));
  const int last = (middle + reach - to_count) / (2 * to_count);
  vec4 sum = vec4(0.0);
  float weights = 0.0;
  for (int j = first; j <= last; ++j) {
    const float weight =
        filter_weight(args.filter_kind, float((2 * j + 1) * to_count - middle) / float(unit));
    const uint element = uint(clamp(j, 0, from_count - 1));
    sum += weight *
           args.from.at[at.x * args.in_line_stride + element * args.in_element_stride];
    weights += weight;
  }
  args.to.at[at.x * args.out_line_stride + at.y * args.out_element_stride] = sum / weights;
}
