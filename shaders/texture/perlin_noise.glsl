// Noise and textures made of it. Source: notes 6.3; Perlin 2002, "Improving Noise"; Worley 1996, "A
// Cellular Texture Basis Function"; Perlin 1985, "An Image Synthesizer" (marble, wood).
#ifndef PARITY_TEXTURE_PERLIN_NOISE_GLSL
#define PARITY_TEXTURE_PERLIN_NOISE_GLSL
#include "texture/layout.h"
#include "transform/trigonometry.glsl"

uint permuted(ref_uint permutation, int i) { return permutation.at[uint(i) & 255u]; }

// The product of an edge direction of the cube, chosen by the hash, and d.
float edge_product(uint hash, vec3 d) {
  const uint h = hash & 15u;
  const float u = h < 8u ? d.x : d.y;
  const float v = h < 4u ? d.y : (h == 12u || h == 14u ? d.x : d.z);
  return ((h & 1u) == 0u ? u : -u) + ((h & 2u) == 0u ? v : -v);
}

float perlin_noise(ref_uint permutation, vec3 p) {
  const vec3 cell = floor(p);
  const ivec3 c = ivec3(cell);
  const vec3 d = p - cell;
  const vec3 fade = d * d * d * (d * (d * 6.0 - 15.0) + 10.0);
  float planes[2];
  [[dont_unroll]] for (int k = 0; k < 2; ++k) {
    float rows[2];
    [[dont_unroll]] for (int j = 0; j < 2; ++j) {
      const int left = int(permuted(permutation, int(permuted(permutation, c.x)) + c.y + j));
      const int right = int(permuted(permutation, int(permuted(permutation, c.x + 1)) + c.y + j));
      const float a = edge_product(permuted(permutation, left + c.z + k), d - vec3(0.0, j, k));
      const float b = edge_product(permuted(permutation, right + c.z + k), d - vec3(1.0, j, k));
      rows[j] = a + fade.x * (b - a);
    }
    planes[k] = rows[0] + fade.y * (rows[1] - rows[0]);
  }
  return planes[0] + fade.z * (planes[1] - planes[0]);
}

// Octaves: signed, or their absolute values.
float noise_octaves(ref_uint permutation, vec3 p, bool absolute) {
  float sum = 0.0;
  float scale = 1.0;
  [[dont_unroll]] for (uint k = 0u; k < procedural_octave_count; ++k) {
    const float noise = perlin_noise(permutation, p * scale);
    sum += (absolute ? abs(noise) : noise) / scale;
    scale *= 2.0;
  }
  return sum;
}

// Distance to the nearest point of the 27 cells around; each cell has one.
float worley_noise(ref_uint permutation, vec3 p) {
  const ivec3 c = ivec3(floor(p));
  float nearest = 100.0;
  [[dont_unroll]] for (int i = 0; i < 27; ++i) {
    const ivec3 cell = c + ivec3(i % 3, i / 3 % 3, i / 9) - 1;
    const int column = int(permuted(permutation, cell.x)) + cell.y;
    const int hash = int(permuted(permutation, int(permuted(permutation, column)) + cell.z));
    const vec3 place = vec3(permuted(permutation, hash), permuted(permutation, hash + 85),
                            permuted(permutation, hash + 170)) / 255.0;
    const vec3 d = vec3(cell) + place - p;
    nearest = min(nearest, dot(d, d));
  }
  return sqrt(nearest);
}

float marble(ref_uint permutation, vec3 p) {
  const float vein = p.x + noise_octaves(permutation, p, true);
  return 0.5 + 0.5 * sin_cos(2.0 * 3.14159265358979 * (vein - floor(vein))).x;
}

// Four rings a unit.
float wood(ref_uint permutation, vec3 p) {
  const float ring = 4.0 * sqrt(p.x * p.x + p.z * p.z) + perlin_noise(permutation, p);
  return 1.0 - abs(2.0 * (ring - floor(ring)) - 1.0);
}
#endif
