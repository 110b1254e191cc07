#version 460
#include "fluid/draw_layout.h"

// A pixel of a flow in 2 dimensions: its value's colour, lighter or darker by the noise along the
// streamline through it. One thread a pixel. Source: Cabral & Leedom 1993 (line integral
// convolution).
layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar, push_constant) uniform Push { DrawFieldArgs args; };

/// Index of the lower corner, its distances to the next ones, and how far it is between.
uint corner(vec2 at, ivec2 size, out uvec2 step, out vec2 part) {
  const vec2 inside = clamp(at, vec2(0.0), vec2(size - 1));
  const ivec2 low = max(min(ivec2(inside), size - 2), ivec2(0));
  step = mix(uvec2(0), uvec2(1, size.x), greaterThan(size, ivec2(1)));
  part = inside - vec2(low);
  return uint(low.y * size.x + low.x);
}

vec2 cell_at(vec2 pixel) {
  const vec2 scale = vec2(args.cells) / vec2(args.width, args.height);
  return vec2(pixel.x, float(args.height) - pixel.y) * scale - 0.5;
}

vec2 sample_velocity(vec2 pixel) {
  uvec2 s;
  vec2 f;
  const uint i = corner(cell_at(pixel), args.cells, s, f);
  return mix(mix(args.velocity.at[i], args.velocity.at[i + s.x], f.x),
             mix(args.velocity.at[i + s.y], args.velocity.at[i + s.x + s.y], f.x), f.y);
}

vec2 sample_value_and_solid(vec2 pixel) {
  uvec2 s;
  vec2 f;
  const uint i = corner(cell_at(pixel), args.cells, s, f);
  return mix(mix(args.value_and_solid.at[i], args.value_and_solid.at[i + s.x], f.x),
             mix(args.value_and_solid.at[i + s.y], args.value_and_solid.at[i + s.x + s.y], f.x), f.y);
}

/// At most 1 px long, on the screen.
vec2 direction(vec2 pixel) {
  const vec2 v = sample_velocity(pixel);
  return vec2(v.x, -v.y) / (length(v) + args.slowest);
}

float texel(ivec2 at) {
  const ivec2 n = args.noise_size;
  const ivec2 inside = at - n * ivec2(floor(vec2(at) / vec2(n)));
  return args.noise.at[uint(clamp(inside.y, 0, n.y - 1) * n.x + clamp(inside.x, 0, n.x - 1))];
}

float noise_at(vec2 pixel) {
  const vec2 at = pixel / args.noise_scale - 0.5, low = floor(at), part = at - low;
  const ivec2 i = ivec2(low);
  return mix(mix(texel(i), texel(i + ivec2(1, 0)), part.x),
             mix(texel(i + ivec2(0, 1)), texel(i + 1), part.x), part.y);
}

/// Weighted noise of one side of the streamline; the weights are added to `total`.
float along_streamline(vec2 pixel, float sense, inout float total) {
  float sum = 0.0;
  for (int k = 1; k <= args.streak; ++k) {
    const vec2 halfway = pixel + 0.5 * sense * direction(pixel);
    pixel += sense * direction(halfway);
    const float c = cos(1.5707963 * float(k) / float(args.streak + 1));
    sum += c * c * noise_at(pixel);
    total += c * c;
  }
  return sum;
}

vec3 color_of(float value) {
  const float at = clamp(value, 0.0, 1.0) * float(args.color_count - 1u);
  const uint low = min(uint(at), args.color_count - 2u);
  return mix(args.color_map.at[low], args.color_map.at[low + 1u], at - float(low));
}

void main() {
  const uvec2 i = gl_GlobalInvocationID.xy;
  if (i.x >= args.width || i.y >= args.height) return;
  const vec2 pixel = vec2(i) + 0.5;
  float total = 1.0;
  float noise = noise_at(pixel);
  noise += along_streamline(pixel, 1.0, total);
  noise += along_streamline(pixel, -1.0, total);
  const vec2 value = sample_value_and_solid(pixel);
  const float gain = 1.5 * sqrt(float(max(args.streak, 1)));
  const float streak = clamp((noise / total - 0.5) * gain, -1.0, 1.0) * length(direction(pixel));
  const vec3 color = color_of(value.x) * (1.0 + args.contrast * streak);
  args.picture.at[i.y * args.width + i.x] = vec4(mix(color, args.solid_color, value.y), 1.0);
}
