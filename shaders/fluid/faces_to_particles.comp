#version 460
#include "numerics/layout.h"
#include "fluid/layout.h"
#include "fluid/grid.glsl"
#include "fluid/liquid.glsl"
#include "fluid/solid.glsl"

// New velocity of each particle from the faces around it, and its move along it; one thread a
// particle. FLIP takes the change of the faces, PIC and APIC their velocity. Source: Zhu & Bridson
// 2005; Jiang et al. 2015.
layout(local_size_x = 64) in;
layout(scalar, push_constant) uniform Push { LiquidArgs args; };

const uint method_apic = 5u;

/// Velocity of an axis at a place before and now, and its gradient a cell.
struct Gathered {
  float old;
  float now;
  vec3 slope;
};

Gathered gather(FluidScene scene, uint axis, vec3 place) {
  const ivec3 size = points_of(scene.cells, axis);
  ivec3 low, high;
  vec3 part, inside;
  for (uint d = 0u; d < 3u; ++d) {
    const float at = place[d] - (d == axis ? 0.0 : 0.5);
    inside[d] = 1.0;
    if (wraps(scene, d)) {
      const int period = int(scene.cells[d]);
      low[d] = (int(floor(at)) % period + period) % period;
      high[d] = (low[d] + 1) % period;
      part[d] = at - floor(at);
    } else {
      const float c = clamp(at, 0.0, float(size[d] - 1));
      low[d] = min(int(c), max(size[d] - 2, 0));
      high[d] = min(low[d] + 1, size[d] - 1);
      part[d] = c - float(low[d]);
      if (c != at || low[d] == high[d]) inside[d] = 0.0;
    }
  }
  Gathered g = Gathered(0.0, 0.0, vec3(0.0));
  for (uint k = 0u; k < 8u; ++k) {
    const bvec3 up = bvec3((k & 1u) != 0u, (k & 2u) != 0u, (k & 4u) != 0u);
    const uint index = point_index(size, mix(low, high, up));
    const vec3 w = mix(1.0 - part, part, up), sign = mix(vec3(-1.0), vec3(1.0), up) * inside;
    const float now = read_face(args.velocity, axis, index);
    g.now += w.x * w.y * w.z * now;
    g.old += w.x * w.y * w.z * read_face(args.old, axis, index);
    g.slope += now * vec3(sign.x * w.y * w.z, w.x * sign.y * w.z, w.x * w.y * sign.z);
  }
  return g;
}

/// Inside the domain and outside solids.
vec3 kept_inside(FluidScene scene, vec3 position) {
  const float margin = 1e-3 * scene.spacing;
  const vec3 size = scene.spacing * vec3(scene.cells);
  vec3 p = position - scene.origin;
  for (uint d = 0u; d < 3u; ++d) {
    if (wraps(scene, d)) {
      p[d] -= size[d] * floor(p[d] / size[d]);
    } else {
      p[d] = clamp(p[d], margin, size[d] - margin);
    }
  }
  p += scene.origin;
  if (scene.solid_count == 0u) return p;
  const float time = args.clock.at[0].time + args.clock.at[0].step;
  const float d = nearest_solid(scene, time, p).w;
  if (d >= margin) return p;
  vec3 out_of;
  for (uint k = 0u; k < 3u; ++k)
    out_of[k] = nearest_solid(scene, time, p + margin * vec3(unit(k))).w -
                nearest_solid(scene, time, p - margin * vec3(unit(k))).w;
  return length(out_of) > 0.0 ? p + (margin - d) * normalize(out_of) : p;
}

void main() {
  const float step = args.clock.at[0].step;
  const uint id = gl_GlobalInvocationID.x;
  if (step == 0.0 || id >= args.count) return;
  FluidScene scene = args.scene.at[0];
  const vec3 position = args.positions.at[id];
  const vec3 place = place_of_particle(scene, position);
  vec3 old, now;
  mat3 gradient;  // [d][axis]: of the axis' velocity along d, 1/s
  for (uint axis = 0u; axis < 3u; ++axis) {
    const Gathered g = gather(scene, axis, place);
    old[axis] = g.old;
    now[axis] = g.now;
    for (uint d = 0u; d < 3u; ++d) gradient[d][axis] = g.slope[d] / scene.spacing;
  }
  args.velocities.at[id] =
      scene.method == method_apic
          ? now
          : scene.flip_ratio * (args.velocities.at[id] + (now - old)) + (1.0 - scene.flip_ratio) * now;
  args.gradients.at[id] = scene.method == method_apic ? gradient : mat3(0.0);
  // The midpoint rule, with the velocity there from the gradient here.
  const vec3 middle = now + 0.5 * step * (gradient * now);
  args.positions.at[id] = kept_inside(scene, position + step * middle);
}
