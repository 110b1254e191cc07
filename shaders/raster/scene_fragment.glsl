// The fragment stage of the scene. Source: glTF 2.0, section 3.9.
#ifndef PARITY_RASTER_SCENE_FRAGMENT_GLSL
#define PARITY_RASTER_SCENE_FRAGMENT_GLSL
#include "raster/scene_layout.h"
#include "raster/scene_shade.glsl"

layout(scalar, push_constant) uniform Push { SceneArgs args; };

layout(constant_id = 8) const bool in_order = false;  // blended: culls by itself

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 0) out vec4 out_color;

// Without what only textures and vertex colours need.
Fragment plain_fragment(uint draw_flags) {
  Fragment f;
  f.position = position;
  f.normal = normal;
  f.tangent = vec4(0.0);
  f.color = vec4(1.0);
  for (uint i = 0u; i < 3u; ++i) f.uv[i] = f.uv_dx[i] = f.uv_dy[i] = vec4(0.0);
  f.pixel = uvec2(gl_FragCoord.xy);
  f.scale = 1.0;
  f.front = gl_FrontFacing != ((draw_flags & draw_flag_mirrored) != 0u);
  return f;
}

// Colour (straight) and alpha of this fragment, unless it is cut out.
vec4 finish(Fragment f, uint material, uint draw_flags) {
  const bool unlit = (draw_flags & draw_flag_unlit) != 0u;
  const vec4 result = shade_fragment(args, material, unlit, f);
  if (cuts_out && result.a < 0.0) discard;
  if (in_order && !f.front) {
    const uint flags = args.materials.at[material].flags;
    if ((flags & material_flag_double_sided) == 0u && !unlit) discard;
  }
  return result;
}

// From 0 (near) to 1 (far), linear in the logarithm of the distance. Source: notes 1.5.
float logarithmic_depth() {
  return clamp(log2(1.0 / (gl_FragCoord.w * args.near)) / args.log2_far_over_near, 0.0, 1.0);
}
#endif
