#version 460
#include "fluid/draw_sphere.glsl"

// Distance of the nearest particle at every sample, one thread a particle. The smallest of a set of
// numbers does not depend on their order.
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
      if (t < draw_far)
        atomicMin(s.at[0].depths.at[uint(y) * s.at[0].width + uint(x)], floatBitsToUint(t));
    }
}
