#version 460
#include "shading/octahedral.glsl"
#include "transform/trigonometry.glsl"

// What a mirror of some roughness shows when it is looked at straight; one thread a texel. Half vectors
// by the distribution (Hammersley points); each direction of light reads a level whose texels are as
// large as the sample's share of directions. Source: Karis 2013; Colbert & Krivanek 2007, "GPU-Based
// Importance Sampling", GPU Gems 3.
layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar, push_constant) uniform Push { MirrorArgs args; };

const float pi = 3.14159265358979;

vec3 source_level(float level, vec2 uv) {
  const uint i = min(uint(level), args.level_count - 2u);
  const vec3 sharper = octahedral_texel(args.source, args.begins.at[i], args.source_side >> i, uv);
  const vec3 softer =
      octahedral_texel(args.source, args.begins.at[i + 1u], args.source_side >> (i + 1u), uv);
  return mix(sharper, softer, level - float(i));
}

void main() {
  const uvec2 pixel = gl_GlobalInvocationID.xy;
  if (pixel.x >= args.side || pixel.y >= args.side) return;
  const uint index = pixel.y * args.side + pixel.x;
  const vec3 n = octahedral_direction((vec2(pixel) + 0.5) / float(args.side));
  if (args.roughness == 0.0) {
    args.mirror.at[index] = vec4(source_level(0.0, octahedral_uv(n)), 1.0);
    return;
  }
  const vec3 helper = abs(n.x) < 0.55 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
  const vec3 t = normalize(cross(helper, n));
  const vec3 b = cross(n, t);
  const float a2 = args.roughness * args.roughness * args.roughness * args.roughness;
  const float texel = 4.0 * pi / float(args.source_side * args.source_side);
  vec3 sum = vec3(0.0);
  float weight = 0.0;
  for (uint i = 0u; i < args.samples; ++i) {
    const float u = (float(i) + 0.5) / float(args.samples);
    const float v = float(bitfieldReverse(i) >> 8) * (1.0 / 16777216.0);
    const float spread = (1.0 - u) + a2 * u;
    const float cosine2 = (1.0 - u) / spread;
    const float sine = sqrt(a2 * u / spread);
    const vec2 around = sin_cos(2.0 * pi * v);
    const vec3 h = sine * (around.y * t + around.x * b) + sqrt(cosine2) * n;
    const float n_l = 2.0 * cosine2 - 1.0;
    if (!(n_l > 0.0)) continue;
    // D = a2 / (pi (1 + (a2 - 1) cos^2)^2), and spread = a2 / that; directions have a quarter of it.
    const float bottom = a2 / spread;
    const float share = 4.0 * pi * bottom * bottom / (a2 * float(args.samples));
    const float level = clamp(0.5 * log2(share / texel) + 1.0, 0.0, float(args.level_count - 1u));
    sum += n_l * source_level(level, octahedral_uv(2.0 * sqrt(cosine2) * h - n));
    weight += n_l;
  }
  args.mirror.at[index] = vec4(sum / weight, 1.0);
}
