#version 460
#include "raster/bare_layout.h"
#include "shading/metallic_roughness.glsl"

// One fragment: a dielectric surface under one distant light and a uniform environment.
// Source: notes 6.2; glTF 2.0, appendix B.
layout(scalar, push_constant) uniform Push { BareArgs args; };

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 0) out vec4 color;

void main() {
  const vec3 n = unit_or_zero(normal);
  const vec3 v = unit_or_zero(args.eye - position);
  BareMaterial material = args.material.at[0u];
  Microsurface m;
  m.diffuse = material.base_color;
  m.reflectance = vec3(0.04);
  m.grazing = 1.0;
  m.border = vec2(0.04, 1.0);
  m.roughness = clamp(args.roughness, 0.045, 1.0);
  m.dielectric = m.metal = vec3(0.04);
  m.metallic = 0.0;
  m.albedo = albedo_at(args.albedo_table, view_cosine(n, v), m.roughness);
  const EnvironmentShares s = environment_shares(m);
  color = vec4(material.ambient * (s.mirror + s.bounced + s.entering * m.diffuse) +
                   material.irradiance * reflect_light(m, n, v, args.to_light, args.albedo_table),
               1.0);
}
