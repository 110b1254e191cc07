// What the material extensions of glTF put on the base. Source: KHR_materials_clearcoat, _sheen,
// _anisotropy, _transmission, _volume.
#ifndef PARITY_SHADING_LAYERS_GLSL
#define PARITY_SHADING_LAYERS_GLSL
#include "shading/metallic_roughness.glsl"

struct Layers {
  bool stretched;
  vec3 along;   // unit
  vec3 across;
  vec2 alpha;
  float coat_weight;  // 0: none
  vec3 coat_normal;
  float coat_roughness;
  float coat_n_v;
  vec3 sheen;  // 0: none
  float sheen_roughness;
  float sheen_albedo;
  float transmission;  // 0: none
  vec3 tint;
  float index;
  float depth;  // m
  bool thick;
  bool see_through;
};

float max_component(vec3 c) { return max(c.r, max(c.g, c.b)); }
float min_component(vec3 c) { return min(c.r, min(c.g, c.b)); }

float stretched_lobe(Layers y, vec3 v, vec3 l, vec3 h, float n_h, float n_l, float n_v) {
  const vec2 slope = vec2(dot(y.along, h), dot(y.across, h)) / y.alpha;
  const vec2 slant_l = y.alpha * vec2(dot(y.along, l), dot(y.across, l));
  const vec2 slant_v = y.alpha * vec2(dot(y.along, v), dot(y.across, v));
  return ggx_distribution(dot(slope, slope), n_h, y.alpha.x * y.alpha.y) *
         ggx_visibility(n_l, n_v, length(vec3(slant_l, n_l)), length(vec3(slant_v, n_v)));
}

// BRDF of all layers times the cosine of the light, 1/sr.
vec3 reflect_light(Microsurface m, Layers y, vec3 n, vec3 v, vec3 l, ref_vec4 albedo_table) {
  const float n_l = clamp(dot(n, l), 0.0, 1.0);
  if (!(n_l > 0.0)) return vec3(0.0);
  const vec3 h = unit_or_zero(l + v);
  const float n_v = view_cosine(n, v);
  const float n_h = clamp(dot(n, h), 0.0, 1.0);
  float lobe;
  if (y.stretched)
    lobe = stretched_lobe(y, v, l, h, n_h, n_l, n_v);
  else
    lobe = microfacet_lobe(n, h, n_l, n_v, m.roughness);
  Microsurface base = m;
  base.diffuse *= 1.0 - y.transmission;
  vec3 sum = base_reflection(base, lobe, dot(v, h), n_l, albedo_table);
  if (max_component(y.sheen) > 0.0) {
    const float toward_light = sheen_albedo_at(albedo_table, n_l, y.sheen_roughness);
    const float taken = max_component(y.sheen) * max(y.sheen_albedo, toward_light);
    const vec3 sine = cross(n, h);
    sum = sum * max(1.0 - taken, 0.0) +
          y.sheen * (charlie_distribution(dot(sine, sine), y.sheen_roughness * y.sheen_roughness) *
                     cloth_visibility(n_l, n_v));
  }
  sum *= n_l;
  if (!(y.coat_weight > 0.0)) return sum;
  sum *= 1.0 - y.coat_weight;
  const float coat_n_l = clamp(dot(y.coat_normal, l), 0.0, 1.0);
  if (coat_n_l > 0.0)
    sum += y.coat_weight * coat_n_l *
           microfacet_lobe(y.coat_normal, h, coat_n_l, y.coat_n_v, y.coat_roughness);
  return sum;
}
#endif
