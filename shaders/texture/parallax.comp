#version 460
#include "texture/layout.h"
#include "texture/sample.glsl"

// Where the ray of a pixel meets a height field: the first layer below it, then bisection. One thread
// a ray. Source: notes 6.3; Brawley & Tatarchuk 2004.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { ParallaxArgs args; };

const uint bisections = 8u;

bool is_below(SceneTexture t, vec2 uv, float depth) {
  return depth >= 1.0 - sample_level(t, 0u, true, uv, args.linear_from_srgb).r;
}

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  SceneTexture t;
  t.texels = args.texels;
  t.width = args.width;
  t.height = args.height;
  t.level_count = 1u;
  t.flags = texture_normal;
  const ParallaxRay ray = args.rays.at[i];
  const vec2 way = -args.scale * ray.to_eye.xy / ray.to_eye.z;
  const float layers = float(args.layers);
  float layer = 0.0;
  [[dont_unroll]] while (layer < layers && !is_below(t, ray.uv + way * (layer / layers), layer / layers))
    ++layer;
  float above = max(0.0, layer - 1.0) / layers;
  float below = layer / layers;
  [[dont_unroll]] for (uint k = 0u; k < bisections && above < below; ++k) {
    const float middle = 0.5 * (above + below);
    const bool under = is_below(t, ray.uv + way * middle, middle);
    below = under ? middle : below;
    above = under ? above : middle;
  }
  args.hits.at[i] = vec4(ray.uv + way * below, below, 0.0);
}
