#version 460
#include "raster/light_layout.h"
#include "shading/punctual_light.glsl"

// What a light sends to a point; one thread a pair. Source: notes 6.1; KHR_lights_punctual.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { PunctualLightArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  const IncidentLight light = incident_light(args.lights.at[i], args.points.at[i]);
  args.results.at[i] = vec4(light.to_light, light.irradiance.r);
}
