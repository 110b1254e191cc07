// From what the rasteriser interpolated at a pixel centre to a colour. The raster pipelines and the
// compute renderer both run this. Source: notes 6.2, 6.3; glTF 2.0, sections 3.9 and appendix B.
#ifndef PARITY_RASTER_SCENE_SHADE_GLSL
#define PARITY_RASTER_SCENE_SHADE_GLSL
#include "raster/scene_layout.h"
#include "shading/metallic_roughness.glsl"
#include "shading/punctual_light.glsl"
#include "texture/sample.glsl"

// What the scene holds: what it does not is left out.
layout(constant_id = 0) const bool has_textures = true;
layout(constant_id = 1) const bool has_normal_maps = true;
layout(constant_id = 2) const bool has_light = true;    // of any kind; else all is unlit
layout(constant_id = 3) const uint uv_pair_count = 3u;  // pairs of uv sets that are read
layout(constant_id = 7) const bool has_colors = true;
layout(constant_id = 9) const bool cuts_out = true;    // alpha masks
layout(constant_id = 12) const bool blends = true;     // alpha of the material
layout(constant_id = 13) const bool has_unlit = true;  // points and lines too
layout(constant_id = 14) const bool one_material = false;  // the arguments hold its factors
layout(constant_id = 4) const float largest_value = 3.4028234e38;  // of the target

struct Fragment {
  vec3 position;  // relative to the origin
  vec3 normal;
  vec4 tangent;
  vec4 color;
  vec4 uv[3];  // slots 0 and 1, 2 and 3, 4 and 5, and what they change in a pixel
  vec4 uv_dx[3];
  vec4 uv_dy[3];
  bool front;
};

// All that textures change of a material.
struct Texels {
  vec4 base_color;
  vec3 metallic_roughness;
  vec3 normal;  // 0 to 1
  bool bends;   // there is a normal map
  float occlusion;
  vec3 emission;
};

vec2 uv_of_slot(vec4 pairs[3], uint slot) {
  vec4 pair = pairs[0];
  if (uv_pair_count > 1u && slot >= 2u) pair = pairs[1];
  if (uv_pair_count > 2u && slot >= 4u) pair = pairs[2];
  return (slot & 1u) == 0u ? pair.xy : pair.zw;
}

Texels read_textures(SceneArgs args, SceneMaterial material, Fragment f) {
  Texels result = Texels(vec4(1.0), vec3(1.0), vec3(0.5, 0.5, 1.0), false, 1.0, vec3(1.0));
  if (!has_textures) return result;
  [[dont_unroll]] for (uint i = 0u; i < material.texture_count; ++i) {
    SceneTexture t = args.textures.at[material.first_texture + i];
    const uint role = t.flags & texture_role_mask;
    const uint slot = (t.flags >> texture_slot_shift) & 7u;
    const vec2 uv = uv_of_slot(f.uv, slot);
    const vec2 dx = uv_of_slot(f.uv_dx, slot);
    const vec2 dy = uv_of_slot(f.uv_dy, slot);
    const vec4 value = sample_texture(
        t, vec2(dot(t.u_from_uv, vec3(uv, 1.0)), dot(t.v_from_uv, vec3(uv, 1.0))),
        vec2(dot(t.u_from_uv.xy, dx), dot(t.v_from_uv.xy, dx)),
        vec2(dot(t.u_from_uv.xy, dy), dot(t.v_from_uv.xy, dy)), args.linear_from_srgb);
    if (role == texture_base_color) result.base_color = value;
    if (role == texture_metallic_roughness) result.metallic_roughness = value.rgb;
    if (role == texture_normal) {
      result.normal = value.rgb;
      result.bends = true;
    }
    if (role == texture_occlusion) result.occlusion = value.r;
    if (role == texture_emission) result.emission = value.rgb;
  }
  return result;
}

// The interpolated normal turned to the viewer's side, bent by the normal map.
vec3 shading_normal(SceneMaterial material, Fragment f, Texels texels) {
  const float side = f.front ? 1.0 : -1.0;
  const vec3 n = unit_or_zero(f.normal) * side;
  if (!has_normal_maps || !texels.bends) return n;
  const vec3 m = (2.0 * texels.normal - 1.0) * vec3(material.normal_scale, material.normal_scale, 1.0);
  const vec3 t = unit_or_zero(f.tangent.xyz) * side;
  const vec3 b = cross(n, t) * (f.tangent.w * side);
  return unit_or_zero(m.x * t + m.y * b + m.z * n);
}

vec3 lit_radiance(SceneArgs args, SceneMaterial material, Fragment f, Texels texels, vec3 base) {
  const vec3 n = shading_normal(material, f, texels);
  const vec3 v = args.orthographic != 0u ? args.backward : unit_or_zero(-f.position);
  const Microsurface m = microsurface(base, material.metallic * texels.metallic_roughness.b,
                                      material.roughness * texels.metallic_roughness.g);
  const float occlusion = 1.0 + material.occlusion_strength * (texels.occlusion - 1.0);
  vec3 sum = material.emission * texels.emission +
             args.ambient * occlusion * reflect_environment(m, view_cosine(n, v));
  [[dont_unroll]] for (uint i = 0u; i < args.light_count; ++i) {
    const IncidentLight light = incident_light(args.lights.at[i], f.position);
    sum += light.irradiance * reflect_light(m, n, v, light.to_light);
  }
  return sum;
}

SceneMaterial material_of(SceneArgs args, uint index) {
  SceneMaterial material = args.materials.at[index];
  if (one_material) {
    material.base_color = args.base_color;
    material.emission = args.emission;
    material.metallic = args.metallic;
    material.roughness = args.roughness;
  }
  return material;
}

// Colour (straight) and alpha. Alpha below 0: the fragment is cut out.
vec4 shade_fragment(SceneArgs args, uint material_index, bool unlit, Fragment f) {
  const SceneMaterial material = material_of(args, material_index);
  const Texels texels = read_textures(args, material, f);
  const vec4 base = material.base_color * texels.base_color * f.color;
  const bool mask = cuts_out && (material.flags & material_flag_mask) != 0u;
  const bool blend = blends && (material.flags & material_flag_blend) != 0u;
  if (mask && base.a < material.alpha_cutoff) return vec4(0.0, 0.0, 0.0, -1.0);
  vec3 color = base.rgb;
  const bool shows_base = has_unlit && (unlit || (material.flags & material_flag_unlit) != 0u);
  if (has_light && !shows_base)
    color = lit_radiance(args, material, f, texels, base.rgb);
  return vec4(min(color, vec3(largest_value)), blend ? base.a : 1.0);
}
#endif
