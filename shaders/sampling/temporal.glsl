#include "sampling/layout.h"

// Temporal accumulation of jittered frames. Sources: notes 1.8; Karis 2014, "High quality temporal
// supersampling"; Yang, Liu & Salvi 2020.

vec4 history_texel(TemporalArgs args, ivec2 at) {
  const ivec2 inside = clamp(at, ivec2(0), ivec2(args.width, args.height) - 1);
  return args.history.at[inside.y * int(args.width) + inside.x];
}

// Bilinear between the middles of the pixels.
vec4 history_at(TemporalArgs args, vec2 place) {
  const vec2 from_middle = place - 0.5, corner = floor(from_middle), weight = from_middle - corner;
  const ivec2 at = ivec2(corner);
  const vec4 above = mix(history_texel(args, at), history_texel(args, at + ivec2(1, 0)), weight.x);
  const vec4 below =
      mix(history_texel(args, at + ivec2(0, 1)), history_texel(args, at + ivec2(1, 1)), weight.x);
  return mix(above, below, weight.y);
}

void neighbour_range(TemporalArgs args, ivec2 pixel, out vec3 low, out vec3 high) {
  low = vec3(1e30);
  high = vec3(-1e30);
  const ivec2 from = max(pixel - 1, ivec2(0));
  const ivec2 to = min(pixel + 1, ivec2(args.width, args.height) - 1);
  for (int y = from.y; y <= to.y; ++y)
    for (int x = from.x; x <= to.x; ++x) {
      const vec3 color = args.current.at[y * int(args.width) + x].rgb;
      low = min(low, color);
      high = max(high, color);
    }
}

// Colour of a pixel after this frame, and how many frames it stands for.
vec4 accumulated(TemporalArgs args, uvec2 pixel) {
  const uint at = pixel.y * args.width + pixel.x;
  const vec3 current = args.current.at[at].rgb;
  const vec2 place = vec2(pixel) + 0.5 + args.motion.at[at];
  if (any(lessThan(place, vec2(0.0))) || any(greaterThan(place, vec2(args.width, args.height))))
    return vec4(current, 1.0);
  vec4 history = history_at(args, place);
  if (args.clamps != 0u) {
    vec3 low, high;
    neighbour_range(args, ivec2(pixel), low, high);
    const vec3 held = clamp(history.rgb, low, high);
    const vec3 lost = abs(history.rgb - held) / (high - low + 0.0625);
    history = vec4(held, history.w * (1.0 - min(max(lost.r, max(lost.g, lost.b)), 1.0)));
  }
  const float frames = min(history.w + 1.0, args.longest);
  return vec4(mix(history.rgb, current, 1.0 / frames), frames);
}
