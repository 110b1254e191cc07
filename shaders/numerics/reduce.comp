#version 460
#include "numerics/layout.h"
#include "numerics/tiles.glsl"

// Partial results to one number, always in the same order, and what an iteration makes of it; one
// workgroup. Source: notes 9.3; Polak & Ribiere 1969 for beta, which allows a preconditioner that is
// only nearly symmetric.
layout(local_size_x = 256) in;
layout(scalar, push_constant) uniform Push { ReduceArgs args; };

const uint largest_residual = 0u;  ///< residual; done where it is within the tolerance
const uint next_direction = 1u;    ///< pairs z . r, z . q: beta and rho
const uint step_length = 2u;       ///< d . q: alpha
const uint mean = 3u;              ///< pairs sum, count
const uint cycle_residual = 4u;    ///< as largest_residual, after a cycle

bool is_largest() { return args.mode == largest_residual || args.mode == cycle_residual; }

shared vec2 sums[256];

void finish(vec2 total) {
  const SolverControl c = args.control.at[0];
  if (is_largest()) {
    if (args.mode == cycle_residual) args.control.at[0].iterations = c.iterations + 1u;
    args.control.at[0].residual = total.x;
    args.control.at[0].done = total.x <= c.tolerance ? 1u : 0u;
  } else if (args.mode == next_direction) {
    args.control.at[0].beta = c.rho != 0.0 ? -c.alpha * total.y / c.rho : 0.0;
    args.control.at[0].rho = total.x;
    args.control.at[0].iterations = c.iterations + 1u;
  } else if (args.mode == step_length) {
    args.control.at[0].alpha = total.x != 0.0 ? c.rho / total.x : 0.0;
  } else {
    // Beside tiles that are left out is air: then any right side has a solution.
    const bool open = with_tiles != 0u && args.tiles.at[0].groups.at[active_tiles] < args.count;
    args.control.at[0].mean = total.y > 0.0 && !open ? total.x / total.y : 0.0;
  }
}

void main() {
  if (args.control.at[0].done != 0u) return;
  const uint id = gl_LocalInvocationID.x;
  const uint chunk = (args.count + 255u) / 256u;
  uint begin = id * chunk, end = min((id + 1u) * chunk, args.count);
  if (with_tiles != 0u) {
    TileTable table = args.tiles.at[0];
    begin = 4u * table.starts.at[id];
    end = 4u * table.starts.at[id + 1u];
  }
  const bool pairs = args.mode == next_direction || args.mode == mean;
  vec2 sum = vec2(0.0);
  for (uint k = begin; k < end; ++k) {
    if (is_largest()) {
      sum.x = max(sum.x, args.partials.at[k]);
    } else if (pairs) {
      sum += vec2(args.partials.at[2u * k], args.partials.at[2u * k + 1u]);
    } else {
      sum.x += args.partials.at[k];
    }
  }
  sums[id] = sum;
  barrier();
  if (id != 0u) return;
  for (uint k = 1u; k < 256u; ++k)
    sum = is_largest() ? max(sum, sums[k]) : sum + sums[k];
  finish(sum);
}
