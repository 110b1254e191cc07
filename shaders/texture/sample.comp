#version 460
#include "texture/layout.h"
#include "texture/sample.glsl"

// Reads a texture at a footprint; one thread a footprint. Source: notes 6.3.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { TextureSampleArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  SceneTexture t;
  t.texels = args.texels;
  t.width = args.width;
  t.height = args.height;
  t.level_count = args.level_count;
  t.flags = args.flags;
  const TextureFootprint f = args.footprints.at[i];
  args.colors.at[i] = sample_texture(t, f.uv, f.uv_dx, f.uv_dy, args.linear_from_srgb);
}
