#version 460
#pragma no_contraction
#include "shading/ambient_occlusion.glsl"

// The share of the sky, weighted by the cosine, that each pixel's surface sees; one thread a pixel.
// Texels are looked at along lines that meet their middles, so that those of a plane lie on it.
// Source: notes 6.2; Jimenez et al. 2016. Differs from the paper: divided by what the same slices
// find where nothing hides the sky, so that a plane sees all of it.
layout(local_size_x = 8, local_size_y = 8) in;
layout(scalar, push_constant) uniform Push { OcclusionArgs args; };

bool is_inside(ivec2 at) {
  return at.x >= 0 && at.y >= 0 && at.x < int(args.width) && at.y < int(args.height);
}

float distance_at(ivec2 at) {
  return args.distances.at[uint(at.y) * args.width + uint(at.x)];
}

float other_distance(ivec2 at) { return is_inside(at) ? distance_at(at) : uintBitsToFloat(0x7f800000u); }

// Along a row or a column, to the neighbour whose distance differs less; 0 without one.
vec3 difference(OcclusionView view, ivec2 pixel, ivec2 step, vec3 p) {
  const float here = -p.z;
  const float ahead = other_distance(pixel + step), back = other_distance(pixel - step);
  if (isinf(ahead) && isinf(back)) return vec3(0.0);
  precise const float rise_ahead = abs(ahead - here);
  precise const float rise_back = abs(back - here);
  if (rise_ahead <= rise_back) return position_at(view, pixel + step, ahead) - p;
  return p - position_at(view, pixel - step, back);
}

// Toward the eye; the eye's own direction where no neighbours are.
vec3 surface_normal(OcclusionView view, ivec2 pixel, vec3 p, vec3 v) {
  const vec3 n = cross(difference(view, pixel, ivec2(0, 1), p), difference(view, pixel, ivec2(1, 0), p));
  const float squared = dot(n, n);
  if (!(squared > 0.0)) return v;
  const vec3 unit = n * inversesqrt(squared);
  return dot(unit, v) < 0.0 ? -unit : unit;
}

// The cosine of the horizon on one side: that of the surface's own plane, or of what rises over it.
float horizon(OcclusionView view, ivec2 pixel, vec3 p, vec3 v, ivec2 direction, float reach, float flat_cosine) {
  float highest = flat_cosine;
  const float end = args.radius * args.radius;
  const float begin = end * (occlusion_fade * occlusion_fade);
  for (uint i = 0u; i < args.steps; ++i) {
    precise const float far = floor(reach * args.parts.at[i] + 0.5);
    const ivec2 at = pixel + direction * int(clamp(far, float(i + 1u), 65536.0));
    if (!is_inside(at)) break;
    const float distance = distance_at(at);
    if (isinf(distance)) continue;
    const vec3 d = position_at(view, at, distance) - p;
    const float squared = dot(d, d);
    const float weight = clamp((end - squared) / (end - begin), 0.0, 1.0);
    if (squared > 0.0)
      highest = max(highest, mix(flat_cosine, dot(d, v) * inversesqrt(squared), weight));
  }
  return highest;
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (!is_inside(pixel)) return;
  const uint index = uint(pixel.y) * args.width + uint(pixel.x);
  const float distance = args.distances.at[index];
  if (isinf(distance)) {
    args.openness.at[index] = 1.0;
    return;
  }
  const OcclusionView view =
      OcclusionView(args.slope, vec2(args.width, args.height), args.orthographic != 0u);
  const vec3 p = position_at(view, pixel, distance);
  const vec3 v = eye_from(view, p);
  const vec3 n = surface_normal(view, pixel, p, v);
  precise const float across = 2.0 * args.slope.x * (view.orthographic ? 1.0 : distance);
  precise const float reach = floor(4.0 * args.radius * view.size.x / across) * 0.25;
  const vec2 texel = args.slope / view.size;
  float open = 0.0, all = 0.0;
  for (uint i = 0u; i < args.slice_count; ++i) {
    const vec4 direction = args.directions.at[i];
    const ivec2 step = ivec2(direction.xy);
    precise const float steps_to_radius = reach * direction.w;
    const vec3 aside = vec3(direction.x * texel.x, -direction.y * texel.y, 0.0);
    const vec3 level = normalize(aside - v * dot(aside, v));
    const vec3 in_slice = vec3(dot(n, level), dot(n, v), 0.0);
    const float size = sqrt(dot(in_slice, in_slice));
    if (!(size > 0.0)) continue;
    const float sine = in_slice.x / size, cosine = in_slice.y / size;
    const float ahead = horizon(view, pixel, p, v, step, steps_to_radius, -sine);
    const float back = horizon(view, pixel, p, v, -step, steps_to_radius, sine);
    open += direction.z * size * (arc_to(ahead, cosine, sine) + arc_to(back, cosine, -sine));
    all += direction.z * size * (arc_to(-sine, cosine, sine) + arc_to(sine, cosine, -sine));
  }
  args.openness.at[index] = all > 0.0 ? clamp(open / all, 0.0, 1.0) : 1.0;
}
