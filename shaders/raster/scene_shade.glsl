// From what the rasteriser interpolated at a pixel centre to a colour. The raster pipelines and the
// compute renderer both run this. Source: notes 6.2, 6.3; glTF 2.0, sections 3.9 and appendix B.
#ifndef PARITY_RASTER_SCENE_SHADE_GLSL
#define PARITY_RASTER_SCENE_SHADE_GLSL
#include "raster/scene_layout.h"
#include "shading/behind.glsl"
#include "shading/environment.glsl"
#include "shading/layers.glsl"
#include "shading/light_shadow.glsl"
#include "shading/thin_film.glsl"
#include "shading/punctual_light.glsl"
#include "texture/sample.glsl"
#include "texture/surface_detail.glsl"

// What the scene holds: what it does not is left out.
layout(constant_id = 0) const bool has_textures = true;
layout(constant_id = 1) const bool has_normal_maps = true;
layout(constant_id = 2) const bool has_light = true;    // of any kind; else all is unlit
layout(constant_id = 3) const uint uv_pair_count = 3u;  // pairs of uv sets that are read
layout(constant_id = 7) const bool has_colors = true;
layout(constant_id = 9) const bool cuts_out = true;    // alpha masks
layout(constant_id = 12) const bool blends = true;     // alpha of the material
layout(constant_id = 13) const bool has_unlit = true;  // points and lines too
layout(constant_id = 14) const bool one_material = false;  // `materials` begins with it
layout(constant_id = 22) const bool has_layers = true;       // extensions of materials
layout(constant_id = 23) const bool has_environment = true;  // a picture of it
layout(constant_id = 26) const bool has_openness = true;     // of each place of the picture
layout(constant_id = 4) const float largest_value = 3.4028234e38;  // of the target

struct Fragment {
  vec3 position;  // relative to the origin
  vec3 normal;
  vec4 tangent;
  vec4 color;
  vec4 uv[3];  // slots 0 and 1, 2 and 3, 4 and 5, and what they change in a pixel
  vec4 uv_dx[3];
  vec4 uv_dy[3];
  uvec2 pixel;
  float scale;  // of the object
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
  vec4 specular;  // colour and strength
  vec3 coat;      // strength, roughness, unused
  vec3 coat_normal;
  vec4 sheen;  // colour and roughness
  vec3 anisotropy;
  vec2 transmission;  // strength, thickness
  vec2 film;          // strength, thickness
};

Texels white_texels() {
  Texels t;
  t.base_color = t.specular = t.sheen = vec4(1.0);
  t.metallic_roughness = t.emission = t.coat = vec3(1.0);
  t.normal = t.coat_normal = vec3(0.5, 0.5, 1.0);
  t.bends = false;
  t.occlusion = 1.0;
  t.anisotropy = vec3(1.0, 0.5, 1.0);
  t.transmission = t.film = vec2(1.0);
  return t;
}

void keep_layer_texel(inout Texels t, uint role, vec4 value) {
  if (role == texture_specular) t.specular.a = value.a;
  if (role == texture_specular_color) t.specular.rgb = value.rgb;
  if (role == texture_clearcoat) t.coat.x = value.r;
  if (role == texture_clearcoat_roughness) t.coat.y = value.g;
  if (role == texture_clearcoat_normal) t.coat_normal = value.rgb;
  if (role == texture_sheen_color) t.sheen.rgb = value.rgb;
  if (role == texture_sheen_roughness) t.sheen.a = value.a;
  if (role == texture_anisotropy) t.anisotropy = value.rgb;
  if (role == texture_iridescence) t.film.x = value.r;
  if (role == texture_iridescence_thickness) t.film.y = value.g;
  if (role == texture_transmission) t.transmission.x = value.r;
  if (role == texture_thickness) t.transmission.y = value.g;
}

vec2 uv_of_slot(vec4 pairs[3], uint slot) {
  vec4 pair = pairs[0];
  if (uv_pair_count > 1u && slot >= 2u) pair = pairs[1];
  if (uv_pair_count > 2u && slot >= 4u) pair = pairs[2];
  return (slot & 1u) == 0u ? pair.xy : pair.zw;
}

Texels read_textures(SceneArgs args, SceneMaterial material, Fragment f) {
  Texels result = white_texels();
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
    if (has_layers) keep_layer_texel(result, role, value);
  }
  return result;
}

// Unit vectors of the surface, turned to the viewer's side.
struct TangentFrame {
  vec3 tangent;
  float handedness;
  vec3 normal;
};

TangentFrame tangent_frame(Fragment f) {
  const float side = f.front ? 1.0 : -1.0;
  const vec3 n = unit_or_zero(f.normal) * side;
  if (!has_normal_maps) return TangentFrame(vec3(0.0), 1.0, n);
  return TangentFrame(unit_or_zero(f.tangent.xyz) * side, f.tangent.w * side, n);
}

// Bent by a normal map.
vec3 mapped_normal(TangentFrame frame, vec3 texel, float scale) {
  return unit_or_zero(bent_normal(frame.normal, frame.tangent, frame.handedness, texel, scale));
}

// What is common to all materials: a dielectric and a metal, mixed. The reflectances of the dielectric
// at normal incidence and at grazing angles are 0.04 and 1 but for extensions.
Microsurface base_surface(SceneMaterial material, Texels texels, vec3 base, vec3 dielectric,
                          float dielectric_grazing, vec3 metal) {
  const float metallic = has_metal ? material.metallic * texels.metallic_roughness.b : 0.0;
  Microsurface m;
  m.diffuse = base * (1.0 - metallic);
  m.reflectance = dielectric * (1.0 - metallic) + metal * metallic;
  m.grazing = dielectric_grazing * (1.0 - metallic) + metallic;
  m.border = vec2(max_component(dielectric), dielectric_grazing);
  m.roughness = clamp(material.roughness * texels.metallic_roughness.g, 0.045, 1.0);
  m.metal = metal;
  m.dielectric = dielectric;
  m.metallic = metallic;
  m.albedo = vec3(0.0);
  return m;
}

// What a film makes of F0: that of Schlick's curve which meets what the film reflects toward the eye.
vec3 under_film(SceneLayers from, Texels texels, float cosine, vec3 f0, float f90) {
  const float thickness =
      from.film_thickness.x + (from.film_thickness.y - from.film_thickness.x) * texels.film.y;
  const float rise = schlick_weight(cosine);
  const vec3 film = thin_film(from.film_index, thickness, cosine, f0);
  const vec3 straight = clamp((film - f90 * rise) / (1.0 - rise), 0.0, 1.0);
  return f0 + (straight - f0) * (from.iridescence * texels.film.x);
}

Layers layers_of(SceneArgs args, SceneLayers from, uint flags, Microsurface m,
                 TangentFrame frame, vec3 n, vec3 v, Texels texels, float scale) {
  Layers y;
  y.stretched = from.anisotropy > 0.0;
  const vec2 d = 2.0 * texels.anisotropy.xy - 1.0;
  const vec2 turn = from.anisotropy_direction;
  const float strength = from.anisotropy * texels.anisotropy.z;
  y.along = unit_or_zero((turn.x * d.x - turn.y * d.y) * frame.tangent +
                         (turn.y * d.x + turn.x * d.y) * frame.handedness *
                             cross(frame.normal, frame.tangent));
  y.across = cross(n, y.along);
  const float alpha = m.roughness * m.roughness;
  y.alpha = vec2(alpha + (1.0 - alpha) * (strength * strength), alpha);
  y.coat_normal = from.has_coat_normal != 0u
                      ? mapped_normal(frame, texels.coat_normal, from.clearcoat_normal_scale)
                      : frame.normal;
  y.coat_n_v = view_cosine(y.coat_normal, v);
  y.coat_roughness = clamp(from.clearcoat_roughness * texels.coat.y, 0.045, 1.0);
  y.coat_weight = from.clearcoat * texels.coat.x * (0.04 + 0.96 * schlick_weight(y.coat_n_v));
  y.sheen = from.sheen_color * texels.sheen.rgb;
  y.sheen_roughness = clamp(from.sheen_roughness * texels.sheen.a, 0.2, 1.0);
  y.sheen_albedo = sheen_albedo_at(args.albedo_table, view_cosine(n, v), y.sheen_roughness);
  y.transmission = from.transmission * texels.transmission.x;
  y.depth = from.thickness * scale * texels.transmission.y;
  y.tint = m.diffuse * exp2(from.log2_attenuation * y.depth);
  y.index = from.index;
  y.thick = from.thickness > 0.0;
  y.see_through = (flags & material_flag_blend) != 0u;
  return y;
}

vec3 mirror_radiance(SceneArgs args, vec3 direction, float roughness) {
  return has_environment ? mirrored(args.environment, direction, roughness) : args.ambient;
}

vec3 mean_radiance(SceneArgs args, vec3 normal) {
  return has_environment ? irradiance_over_pi(args.environment, normal) : args.ambient;
}

// Where most of the light of a rough mirror comes from, of any length: from smooth to rough the way of
// the mirror turns to the normal. Source: Lagarde & de Rousiers 2014, "Moving Frostbite to PBR", 4.9.3.
vec3 mirror_of(vec3 v, vec3 n, float roughness) {
  const float alpha = roughness * roughness;
  const float part = (1.0 - alpha) * (sqrt(1.0 - alpha) + alpha);
  return n * (1.0 + part * (2.0 * dot(n, v) - 1.0)) - v * part;
}

// What a stretched lobe shows of the surroundings, and the slope and offset of its albedo in F0.
struct Streak {
  vec3 radiance;
  vec2 albedo;
};

// Eight half vectors along the stretch, at the middles of equal parts of the distribution of slopes
// there. Each shows what an isotropic mirror does that is as rough as the lobe is across, or as the
// half vectors are apart. A thousandth of the plain mirror is for where none of them sends light.
Streak streak(SceneArgs args, Layers y, vec3 n, vec3 v, float roughness) {
  const vec3 e = v - n * (2.0 * min(dot(n, v), 0.0));  // not behind the normal
  const float n_v = view_cosine(n, e);
  const float slant_v = length(vec3(y.alpha * vec2(dot(y.along, e), dot(y.across, e)), n_v));
  Streak s = Streak(mirror_radiance(args, mirror_of(v, n, roughness), roughness) * 0.001, vec2(0.0));
  float weights = 0.001;
  [[dont_unroll]] for (uint k = 0u; k < 8u; ++k) {
    const float quantile = (2.0 * float(k) - 7.0) / 8.0;
    const float steep = inversesqrt(1.0 - quantile * quantile);
    const vec3 h = unit_or_zero(n + y.along * (y.alpha.x * quantile * steep));
    const float v_h = max(dot(e, h), 0.0);
    const vec3 l = h * (2.0 * v_h) - e;
    const float n_l = max(dot(n, l), 0.0), n_h = max(dot(n, h), 0.01);
    const float apart = y.alpha.x * (steep * steep * steep) * (n_h * n_h) / 8.0;
    const float alpha = min(max(y.alpha.y * steep * n_h, apart), 1.0);
    s.radiance += mirror_radiance(args, l, sqrt(alpha)) * n_l;
    weights += n_l;
    const float slant_l = length(vec3(y.alpha * vec2(dot(y.along, l), dot(y.across, l)), n_l));
    // D is what half vectors are drawn by: 4 V n.l v.h / n.h is left, a part of 8.
    const float part = 0.25 * n_l * v_h / (n_h * (n_l * slant_v + n_v * slant_l));
    const float rise = schlick_weight(v_h);
    s.albedo += part * vec2(1.0 - rise, rise);
  }
  s.radiance /= weights;
  s.albedo /= max(s.albedo.x + s.albedo.y, 1.0);
  return s;
}

// Where the light of a sheen comes from in the mean: fibres stand on end and send light
// back, the more so the smoother they are. A fit to the lobe's mean direction.
vec3 sheen_way(vec3 n, vec3 v, float roughness) {
  return unit_or_zero(n + (v - n * dot(n, v)) * (0.24 / (roughness * sqrt(roughness))));
}

// The way of the eye's ray within a surface that light passes.
vec3 way_behind(Layers y, vec3 n, vec3 v) {
  if (!y.thick) return -v;
  const float ratio = 1.0 / y.index;
  const float cosine = dot(n, v);
  const float inside = sqrt(max(1.0 - ratio * ratio * (1.0 - cosine * cosine), 0.0));
  return n * (ratio * cosine - inside) - v * ratio;
}

// What is behind a surface that light passes; `open` becomes the share that is left to blending.
vec3 behind(SceneArgs args, Microsurface m, Layers y, vec3 n, vec3 v, vec3 p, vec3 passing,
            inout float open) {
  const float rough = m.roughness * clamp(2.0 * y.index - 2.0, 0.0, 1.0);
  const vec3 way = way_behind(y, n, v);
  const vec3 around = mirror_radiance(args, way, rough);
  if (!has_behind) return (passing - open) * around;
  const vec4 seen = picture_behind(args.screen, p + way * y.depth, rough);
  const float empty = 1.0 - seen.a;
  open = has_environment ? 0.0 : open * empty * (1.0 - picture_behind(args.screen, p, 0.0).a);
  return passing * seen.rgb + (passing * empty - open) * around;
}

// Radiance from all around, without occlusion, and the share of what is behind that is to be seen.
// Light that comes straight, not by mirroring, is let in by `openness`.
vec4 surrounded(SceneArgs args, Microsurface m, Layers y, vec3 n, vec3 v, vec3 p, float openness) {
  vec3 mirror;
  if (has_layers && y.stretched) {
    const Streak seen = streak(args, y, n, v, m.roughness);
    mirror = seen.radiance;
    m.albedo.xy = seen.albedo;
  } else {
    mirror = mirror_radiance(args, mirror_of(v, n, m.roughness), m.roughness);
  }
  const EnvironmentShares s = environment_shares(m);
  const vec3 mean = mean_radiance(args, n) * openness;
  vec3 body = m.diffuse * s.entering * mean;
  float open = 0.0;
  if (has_layers && y.transmission > 0.0) {
    const vec3 passing = y.tint * s.entering * y.transmission;
    if (y.see_through) open = clamp(min_component(passing), 0.0, 1.0 - 1.0 / 256.0);
    body = body * (1.0 - y.transmission) + behind(args, m, y, n, v, p, passing, open);
  }
  vec3 sum = s.mirror * mirror + s.bounced * mean + body;
  if (has_layers && max_component(y.sheen) > 0.0) {
    const float keep = max(1.0 - max_component(y.sheen) * y.sheen_albedo, 0.0);
    sum = sum * keep + y.sheen * y.sheen_albedo * openness *
                           mean_radiance(args, sheen_way(n, v, y.sheen_roughness));
    open *= keep;
  }
  if (has_layers && y.coat_weight > 0.0) {
    const vec3 albedo = albedo_at(args.albedo_table, y.coat_n_v, y.coat_roughness);
    sum = sum * (1.0 - y.coat_weight) +
          mirror_radiance(args, mirror_of(v, y.coat_normal, y.coat_roughness), y.coat_roughness) *
              (y.coat_weight * (albedo.x + albedo.y));
    open *= 1.0 - y.coat_weight;
  }
  return vec4(sum, open);
}

// How much of the sky reaches a fragment, as the picture of that says. What is blended has none.
float openness_at(SceneArgs args, uint flags, uvec2 pixel) {
  if (!has_openness || (flags & material_flag_blend) != 0u) return 1.0;
  const uvec2 have = args.screen.at[0].openness_size, size = args.screen.at[0].size;
  const uvec2 at = min(pixel * have / size, have - 1u);
  return args.screen.at[0].openness.at[at.y * have.x + at.x];
}

// Straight colour and alpha: 1 unless light passes through.
vec4 lit_radiance(SceneArgs args, SceneMaterial material, uint index, Fragment f, Texels texels,
                  vec3 base) {
  const TangentFrame frame = tangent_frame(f);
  vec3 n = frame.normal;
  if (has_normal_maps && texels.bends) n = mapped_normal(frame, texels.normal, material.normal_scale);
  const vec3 v = args.orthographic != 0u ? args.backward : unit_or_zero(-f.position);
  Microsurface m;
  Layers y;
  if (has_layers) {
    SceneLayers layers = args.layers.at[index];
    const float weight = layers.specular * texels.specular.a;
    vec3 dielectric = min(layers.specular_color * texels.specular.rgb, vec3(1.0)) * weight;
    vec3 metal = base;
    if (layers.iridescence > 0.0) {
      dielectric = under_film(layers, texels, view_cosine(n, v), dielectric, weight);
      if (has_metal) metal = under_film(layers, texels, view_cosine(n, v), metal, 1.0);
    }
    m = base_surface(material, texels, base, dielectric, weight, metal);
    y = layers_of(args, layers, material.flags, m, frame, n, v, texels, f.scale);
  } else {
    m = base_surface(material, texels, base, vec3(0.04), 1.0, base);
  }
  m.albedo = albedo_at(args.albedo_table, view_cosine(n, v), m.roughness);
  const float occlusion = 1.0 + material.occlusion_strength * (texels.occlusion - 1.0);
  const float openness = openness_at(args, material.flags, f.pixel);
  const vec4 around = surrounded(args, m, y, n, v, f.position, openness);
  vec3 emission = material.emission * texels.emission;
  if (has_layers) emission *= 1.0 - y.coat_weight;
  vec3 sum = emission + around.rgb * occlusion;
  [[dont_unroll]] for (uint i = 0u; i < args.light_count; ++i) {
    IncidentLight light = incident_light(args.lights.at[i], f.position);
    light.irradiance *= light_reaches(args, args.lights.at[i].shadow, f.position, frame.normal);
    sum += light.irradiance * (has_layers ? reflect_light(m, y, n, v, light.to_light, args.albedo_table)
                                          : reflect_light(m, n, v, light.to_light, args.albedo_table));
  }
  return vec4(sum / (1.0 - around.a), 1.0 - around.a);
}

// Colour (straight) and alpha. Alpha below 0: the fragment is cut out.
vec4 shade_fragment(SceneArgs args, uint material_index, bool unlit, Fragment f) {
  const uint index = one_material ? 0u : material_index;
  const SceneMaterial material = args.materials.at[index];
  const Texels texels = read_textures(args, material, f);
  const vec4 base = material.base_color * texels.base_color * f.color;
  const bool mask = cuts_out && (material.flags & material_flag_mask) != 0u;
  const bool blend = blends && (material.flags & material_flag_blend) != 0u;
  if (mask && base.a < material.alpha_cutoff) return vec4(0.0, 0.0, 0.0, -1.0);
  vec4 color = vec4(base.rgb, 1.0);
  const bool shows_base = has_unlit && (unlit || (material.flags & material_flag_unlit) != 0u);
  if (has_light && !shows_base) color = lit_radiance(args, material, index, f, texels, base.rgb);
  if ((material.flags & material_flag_alpha) != 0u) color.a *= base.a;
  return vec4(min(color.rgb, vec3(largest_value)), blend ? color.a : 1.0);
}
#endif
