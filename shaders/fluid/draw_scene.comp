#version 460
#include "fluid/draw_shade.glsl"

// A pixel of the picture: the average of its samples. One thread a pixel, after draw_nearest and
// draw_light.
layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar, push_constant) uniform Push { DrawPictureArgs args; };

DrawHit particle_at(uint x, uint y, DrawRay ray) {
  REF(DrawScene) s = args.scene;
  DrawHit hit = DrawHit(draw_far, vec3(0.0), vec3(0.0), 0.12);
  if (s.at[0].particle_count == 0u) return hit;
  const uint particle = s.at[0].nearest.at[y * s.at[0].width + x];
  if (particle >= s.at[0].particle_count) return hit;
  const vec3 center = s.at[0].positions.at[particle];
  hit.t = draw_hit_sphere(ray, center, s.at[0].radius);
  hit.normal = normalize(ray.origin + hit.t * ray.direction - center);
  hit.color = s.at[0].colors.at[particle];
  return hit;
}

void main() {
  REF(DrawScene) s = args.scene;
  const uint width = s.at[0].width / args.samples, height = s.at[0].height / args.samples;
  const uvec2 pixel = gl_GlobalInvocationID.xy;
  if (pixel.x >= width || pixel.y >= height) return;
  vec3 sum = vec3(0.0);
  for (uint j = 0u; j < args.samples; ++j)
    for (uint i = 0u; i < args.samples; ++i) {
      const uint x = pixel.x * args.samples + i, y = pixel.y * args.samples + j;
      const DrawRay ray = draw_ray(s, x, y);
      sum += draw_seen(s, ray, particle_at(x, y, ray));
    }
  args.picture.at[pixel.y * width + pixel.x] =
      vec4(sum / float(args.samples * args.samples), 1.0);
}
