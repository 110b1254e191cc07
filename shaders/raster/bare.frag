#version 460
#include "raster/bare_layout.h"
#include "shading/metallic_roughness.glsl"

// One fragment: a grey surface under one distant light and a uniform environment.
// Source: notes 6.2; glTF 2.0, appendix B.
layout(scalar, push_constant) uniform Push { BareArgs args; };

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 0) out vec4 color;

void main() {
  const vec3 n = unit_or_zero(normal);
  const vec3 v = unit_or_zero(args.eye - position);
  const Microsurface m = microsurface(vec3(args.base_color), args.metallic, args.roughness);
  color = vec4(args.ambient * reflect_environment(m, view_cosine(n, v)) +
                   args.irradiance * reflect_light(m, n, v, args.to_light),
               1.0);
}
