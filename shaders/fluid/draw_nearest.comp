#version 460
#include "fluid/draw_sphere.glsl"

// The particle that is nearest at every sample, the first of several; one thread a particle, after
// draw_depth.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { DrawSceneArgs args; };

void main() {
  const uint i = gl_GlobalInvocationID.x;
  REF(DrawScene) s = args.scene;
  if (i >= s.at[0].particle_count) return;
  const vec3 center = s.at[0].positions.at[i];
  const ivec4 bounds = draw_sphere_bounds(s, center);
  for (int y = bounds.z; y <= bounds.w; ++y)
    for (int x = bounds.x; x <= bounds.y; ++x) {
      const float t = draw_hit_sphere(draw_ray(s, uint(x), uint(y)), center, s.at[0].radius);
      const uint sample_index = uint(y) * s.at[0].width + uint(x);
      if (t < draw_far && s.at[0].depths.at[sample_index] == floatBitsToUint(t))
        atomicMin(s.at[0].nearest.at[sample_index], i);
    }
}
