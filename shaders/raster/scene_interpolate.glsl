// What the fixed-function rasteriser interpolates, from the corners of a triangle.
#ifndef PARITY_RASTER_SCENE_INTERPOLATE_GLSL
#define PARITY_RASTER_SCENE_INTERPOLATE_GLSL
#include "raster/scene_compute_layout.h"
#include "raster/scene_shade.glsl"
#include "raster/scene_vertex.glsl"

struct Corners {
  vec4 clip[3];
};

// Perspective-correct barycentric coordinates of a point of the window (x, y from -1 to 1), times a
// common factor whose sign is that of the area (y down). Positions are taken relative to the point
// first, so that small triangles keep their digits. Source: notes 1.6; Olano & Greer 1997.
vec3 homogeneous_weights(Corners c, vec2 point) {
  const vec2 p0 = c.clip[0].xy - point * c.clip[0].w;
  const vec2 p1 = c.clip[1].xy - point * c.clip[1].w;
  const vec2 p2 = c.clip[2].xy - point * c.clip[2].w;
  return vec3(p1.x * p2.y - p1.y * p2.x, p2.x * p0.y - p2.y * p0.x, p0.x * p1.y - p0.y * p1.x);
}

vec3 barycentric(Corners c, vec2 point) {
  const vec3 weights = homogeneous_weights(c, point);
  const float sum = weights.x + weights.y + weights.z;
  return sum != 0.0 ? weights / sum : vec3(1.0, 0.0, 0.0);
}

// Number of the vertex at corner k of the triangle.
uint corner_vertex(SceneDraw draw, uvec2 item, uint k) {
  const uint first = item.y & ~item_second_half;
  const uint later = first != item.y ? 1u : 2u;  // a line's corners: begin begin end, begin end end
  const uint index = draw.corners == 3u ? k : (draw.corners == 2u && k >= later ? 1u : 0u);
  return draw.indices.at[first + index];
}

void add_uv(inout Fragment f, int pair, vec4 uv, float weight, float dx, float dy) {
  f.uv[pair] += weight * uv;
  f.uv_dx[pair] += dx * uv;
  f.uv_dy[pair] += dy * uv;
}

// The fragment of a triangle at a point of the window, from the weights of its corners there and
// their differences to the next pixels.
Fragment weighted(Corners c, SceneDraw draw, uvec2 item, vec2 point, vec3 here, vec3 dx, vec3 dy) {
  Fragment f;
  f.position = vec3(0.0);
  f.normal = vec3(0.0);
  f.tangent = vec4(0.0);
  f.color = vec4(0.0);
  f.pixel = uvec2(0u);
  f.scale = draw.scale;
  for (uint j = 0u; j < 3u; ++j) f.uv[j] = f.uv_dx[j] = f.uv_dy[j] = vec4(0.0);
  [[dont_unroll]] for (uint k = 0u; k < 3u; ++k) {
    const uint v = corner_vertex(draw, item, k);
    f.position += here[k] * vertex_position(draw, draw.positions.at[v]);
    f.normal += here[k] * vertex_normal(draw, v);
    if (has_normal_maps) f.tangent += here[k] * vertex_tangent(draw, v);
    if (has_colors) f.color += here[k] * vertex_color(draw, v);
    if (has_textures && uv_pair_count > 0u) add_uv(f, 0, vertex_uv_pair(draw, 0u, v), here[k], dx[k], dy[k]);
    if (has_textures && uv_pair_count > 1u) add_uv(f, 1, vertex_uv_pair(draw, 1u, v), here[k], dx[k], dy[k]);
    if (has_textures && uv_pair_count > 2u) add_uv(f, 2, vertex_uv_pair(draw, 2u, v), here[k], dx[k], dy[k]);
  }
  // Weights of white may add up to less.
  if (!has_colors || (draw.flags & draw_flag_colors) == 0u) f.color = vec4(1.0);
  const vec3 area = homogeneous_weights(c, point);
  const bool counter_clockwise = area.x + area.y + area.z < 0.0;
  f.front = draw.corners != 3u || counter_clockwise != ((draw.flags & draw_flag_mirrored) != 0u);
  return f;
}

// At the centre of a pixel; derivatives are differences within its 2x2 quad, as dFdxFine and
// dFdyFine take them.
Fragment interpolate(Corners c, SceneDraw draw, uvec2 item, uvec2 pixel, vec2 size) {
  const vec2 point = (vec2(pixel) + 0.5) * 2.0 / size - 1.0;
  const vec2 across = (vec2(pixel ^ 1u) + 0.5) * 2.0 / size - 1.0;
  const vec2 turn = vec2((pixel.x & 1u) != 0u ? 1.0 : -1.0, (pixel.y & 1u) != 0u ? 1.0 : -1.0);
  const vec3 here = barycentric(c, point);
  const vec3 dx = (here - barycentric(c, vec2(across.x, point.y))) * turn.x;
  const vec3 dy = (here - barycentric(c, vec2(point.x, across.y))) * turn.y;
  return weighted(c, draw, item, point, here, dx, dy);
}

// At any place of the window, in px; derivatives are differences to the places a pixel on.
Fragment interpolate_at(Corners c, SceneDraw draw, uvec2 item, vec2 place, vec2 size) {
  const vec2 point = place * 2.0 / size - 1.0, pixel = 2.0 / size;
  const vec3 here = barycentric(c, point);
  const vec3 dx = barycentric(c, point + vec2(pixel.x, 0.0)) - here;
  const vec3 dy = barycentric(c, point + vec2(0.0, pixel.y)) - here;
  return weighted(c, draw, item, point, here, dx, dy);
}
#endif
