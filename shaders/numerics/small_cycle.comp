#version 460
#include "numerics/layout.h"
#include "numerics/pressure.glsl"
#include "numerics/transfer.glsl"

// Multigrid V-cycles over grids that are small enough for one workgroup: a dispatch instead of
// dozens. As the coarse part of a larger cycle, or to the tolerance. Source: notes 9.3; Trottenberg,
// Oosterlee & Schueller 2001.
layout(local_size_x = 256) in;
layout(scalar, push_constant) uniform Push { SmallCycleArgs args; };

shared float largest_of[256];

void wait() {
  memoryBarrierBuffer();
  barrier();
}

struct Place {
  uint i, y, z;
};

uint quad_count(PressureLevel level) { return level.row * level.cells.y * level.cells.z; }

Place place_of(PressureLevel level, uint q) {
  const uint row = level.row;
  return Place(q % row, (q / row) % level.cells.y, q / (row * level.cells.y));
}

void relax(PressureLevel level, uint colour, bool from_zero) {
  for (uint q = gl_LocalInvocationID.x; q < quad_count(level); q += 256u) {
    const Place p = place_of(level, q);
    const uint index = quad_index(level, colour, p.i, p.y, p.z);
    const uvec4 words = load_words(level, index);
    const Stencil s = load_stencil(level, words, colour, p.i, p.y, p.z);
    const vec4 mask = fluid_mask(level, words, p.i, (p.y + p.z + colour) & 1u);
    const vec4 rhs = level.rhs.at[index].cells;
    level.pressure.at[index].cells =
        from_zero ? from_zero_guess(s, rhs, mask) : relaxed(s, rhs, mask);
  }
  wait();
}

void go_down(PressureLevel fine, PressureLevel coarse) {
  const uint row = (coarse.cells.x + 3u) / 4u;
  for (uint q = gl_LocalInvocationID.x; q < row * coarse.cells.y * coarse.cells.z; q += 256u) {
    const uint i = q % row, y = (q / row) % coarse.cells.y, z = q / (row * coarse.cells.y);
    store_row(coarse, i, y, z, restricted_residual(fine, coarse, i, y, z));
  }
  wait();
}

void go_up(PressureLevel fine, PressureLevel coarse) {
  for (uint q = gl_LocalInvocationID.x; q < quad_count(fine); q += 256u) {
    const Place p = place_of(fine, q);
    prolong_quad(fine, coarse, 0u, p.i, p.y, p.z, true);
  }
  wait();
}

/// One V-cycle as a list of steps, so that each kind of step is compiled once.
void cycle(bool from_zero) {
  const uint last = args.count - 1u, legs = 3u * (last - args.first), bottom = 2u * args.sweeps + 1u;
  for (uint k = 0u; k < 2u * legs + bottom; ++k) {
    const bool is_down = k < legs, is_up = k >= legs + bottom;
    const uint leg = is_up ? k - legs - bottom : k;
    const uint l = is_down ? args.first + leg / 3u : (is_up ? last - 1u - leg / 3u : last);
    if (is_down && leg % 3u == 2u) {
      go_down(args.levels.at[l], args.levels.at[l + 1u]);
    } else if (is_up && leg % 3u == 0u) {
      go_up(args.levels.at[l], args.levels.at[l + 1u]);
    } else {
      // Red, black going down; red, black, red ... on the last grid; black, red going up.
      const uint colour = is_down ? leg % 3u : (is_up ? 2u - leg % 3u : (k - legs) & 1u);
      const bool is_first = is_down ? leg % 3u == 0u : !is_up && k == legs;
      relax(args.levels.at[l], colour, is_first && (l > args.first || from_zero));
    }
  }
}

/// Largest |rhs - A p| of the first grid, the same for all threads.
float largest_residual() {
  PressureLevel level = args.levels.at[args.first];
  float largest = 0.0;
  for (uint q = gl_LocalInvocationID.x; q < 2u * quad_count(level); q += 256u) {
    const Place p = place_of(level, q / 2u);
    const vec4 r = abs(load_residual(level, q & 1u, p.i, p.y, p.z));
    largest = max(largest, max(max(r.x, r.y), max(r.z, r.w)));
  }
  largest_of[gl_LocalInvocationID.x] = largest;
  for (uint half_count = 128u; half_count > 0u; half_count /= 2u) {
    barrier();
    if (gl_LocalInvocationID.x < half_count)
      largest_of[gl_LocalInvocationID.x] =
          max(largest_of[gl_LocalInvocationID.x], largest_of[gl_LocalInvocationID.x + half_count]);
  }
  barrier();
  largest = largest_of[0];
  barrier();
  return largest;
}

void main() {
  if (args.control.at[0].done != 0u) return;
  const bool measured = args.cycles > 0u;
  const float tolerance = args.control.at[0].tolerance;
  float residual = 0.0;
  uint cycles = 0u;
  for (;; ++cycles) {
    if (measured) residual = largest_residual();
    if (measured ? cycles == args.cycles || residual <= tolerance : cycles == 1u) break;
    cycle(!measured);
  }
  if (gl_LocalInvocationID.x != 0u || !measured) return;
  args.control.at[0].iterations = cycles;
  args.control.at[0].residual = residual;
  args.control.at[0].done = residual <= tolerance ? 1u : 0u;
}
