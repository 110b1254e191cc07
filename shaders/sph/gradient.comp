#version 460
#include "sph/layout.h"
#include "sph/kernel.glsl"
#include "sph/lists.glsl"

// Gradient of a vector field at a particle by kernels that are corrected to be exact for linear
// fields, from the fluid's particles alone; 0 where they lie so flat that it has none. One thread a
// particle. Source: Randles & Libersky 1996; Bonet & Lok 1999.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { GradientArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= args.count) return;
  const SphConstants c = args.constants.at[0];
  const vec3 place = args.places.at[i].xyz;
  const vec3 value = args.field.at[i].xyz;
  const uint count = args.counts.at[i].x;
  const uint first = list_first(c.capacity, i);
  precise mat3 moments = mat3(0.0);
  precise mat3 slopes = mat3(0.0);
  for (uint k = 0u; k < count; ++k) {
    const uint j = args.lists.at[first + k * list_stride];
    const vec4 other = args.places.at[j];
    precise const vec3 d = place - other.xyz;
    precise const float slope = kernel_slope(squared_length(d), c.inverse_support, c.kernel_scale);
    precise const vec3 gradient = c.mass / other.w * slope * d;
    moments -= outerProduct(d, gradient);
    slopes += outerProduct(args.field.at[j].xyz - value, gradient);
  }
  float trace = moments[0].x + moments[1].y + moments[2].z;
  if (c.grid.reach_z == 0) moments[2].z = 0.5 * trace;  // nothing happens along z
  trace = (moments[0].x + moments[1].y + moments[2].z) / 3.0;
  const bool is_flat = !(determinant(moments) >= 0.05 * trace * trace * trace && trace > 0.0);
  args.gradients.at[args.ids.at[i]] = is_flat ? mat3(0.0) : slopes * inverse(moments);
}
