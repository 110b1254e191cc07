// True displacement: triangles are cut as finely as their displaced edges bend on the screen. Edges
// that are shared by two triangles get the same points in both, bit by bit. Source: notes 6.3; Cook
// 1984, "Shade Trees"; Moule & McCool 2002 (edge factors).
#ifndef PARITY_TEXTURE_DISPLACEMENT_GLSL
#define PARITY_TEXTURE_DISPLACEMENT_GLSL
#include "texture/layout.h"
#include "texture/sample.glsl"

// The height map: where its level begins, its sides, its texels.
float height_at(DisplacementArgs args, vec2 uv) {
  SceneTexture t;
  t.texels = args.heights;
  t.width = args.heights.at[1];
  t.height = args.heights.at[2];
  t.level_count = 1u;
  t.flags = texture_normal;
  return sample_level(t, 0u, true, uv, ref_float(args.heights)).r;
}

vec3 displaced(DisplacementArgs args, DisplacementVertex v) {
  return v.position + v.normal * (args.scale * height_at(args, v.uv));
}

DisplacementVertex between(DisplacementVertex a, DisplacementVertex b, float t) {
  return DisplacementVertex(a.position + (b.position - a.position) * t,
                            a.normal + (b.normal - a.normal) * t, a.uv + (b.uv - a.uv) * t);
}

bool comes_before(DisplacementVertex a, DisplacementVertex b) {
  for (uint i = 0u; i < 3u; ++i)
    if (a.position[i] != b.position[i]) return a.position[i] < b.position[i];
  if (a.uv.x != b.uv.x) return a.uv.x < b.uv.x;
  return a.uv.y < b.uv.y;
}

vec2 pixel_of(DisplacementArgs args, vec3 p) {
  const vec4 clip = args.clip_from_world * vec4(p, 1.0);
  return 0.5 * args.size * clip.xy / max(clip.w, 1e-6);
}

// How far, in pixels, the displaced edge is from `parts` straight pieces at most.
float edge_error(DisplacementArgs args, DisplacementVertex a, DisplacementVertex b, uint parts) {
  const uint samples = displacement_samples / parts;  // a piece
  float worst = 0.0;
  vec3 begin = displaced(args, a);
  [[dont_unroll]] for (uint part = 0u; part < parts; ++part) {
    const vec3 end = displaced(args, between(a, b, float(part + 1u) / float(parts)));
    [[dont_unroll]] for (uint i = 1u; i < samples; ++i) {
      const float share = float(i) / float(samples);
      const vec3 p =
          displaced(args, between(a, b, (float(part) + share) / float(parts)));
      worst = max(worst, distance(pixel_of(args, p), pixel_of(args, begin + (end - begin) * share)));
    }
    begin = end;
  }
  return worst;
}

// The least power of two of pieces that are near enough.
uint edge_factor(DisplacementArgs args, DisplacementVertex a, DisplacementVertex b) {
  const bool swapped = comes_before(b, a);
  const DisplacementVertex first = swapped ? b : a;
  const DisplacementVertex second = swapped ? a : b;
  uint parts = 1u;
  [[dont_unroll]] while (parts < displacement_samples &&
                         edge_error(args, first, second, parts) > args.max_pixels)
    parts *= 2u;
  return parts;
}

// Point number i of n on an edge that is cut into `factor` parts: the nearest of theirs.
DisplacementVertex edge_point(DisplacementVertex a, DisplacementVertex b, uint i, uint n,
                              uint factor) {
  const uint step = n / factor;
  uint place = (i + step / 2u) / step;
  const bool swapped = comes_before(b, a);
  if (swapped) place = factor - place;
  const DisplacementVertex first = swapped ? b : a;
  const DisplacementVertex second = swapped ? a : b;
  if (place == 0u) return first;
  if (place == factor) return second;
  return between(first, second, float(place) / float(factor));
}

// Vertex (row, column) of the lattice of n rows in a triangle; row 0 is corner 0, the ends of row n
// are corners 1 and 2.
DisplacementVertex lattice_vertex(DisplacementArgs args, uint triangle, uint row, uint column) {
  const uvec4 factors = args.factors.at[triangle];
  const uint n = factors.w;
  const DisplacementVertex a = args.vertices.at[3u * triangle];
  const DisplacementVertex b = args.vertices.at[3u * triangle + 1u];
  const DisplacementVertex c = args.vertices.at[3u * triangle + 2u];
  if (row == 0u) return a;
  if (row == n) return edge_point(b, c, column, n, factors.x);
  if (column == row) return edge_point(a, c, row, n, factors.y);
  if (column == 0u) return edge_point(a, b, row, n, factors.z);
  const float down = float(row) / float(n);
  return between(between(a, b, down), between(a, c, down), float(column) / float(row));
}
#endif
