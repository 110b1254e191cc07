#pragma once

#include <span>
#include <vector>

#include "geometry/raster.h"

namespace parity::cpu {

/// Window positions of clip positions: the divide by w, then the viewport that covers the whole
/// target. NDC (-1, -1) is the top left corner (0, 0), (1, 1) the bottom right one; z stays.
///
/// @param clip  w != 0 where the answer is to be used.
/// @return      (x px, y px, z, 1/w), one a position.
///
/// Source: notes 1.2, 2.6; Vulkan 1.3, "Controlling the Viewport". Differs from the notes: y points
/// down, and z has a row too. The divide is made per vertex, after clipping.
std::vector<dvec4> to_window(std::span<const vec4> clip, int width, int height);

/// The fixed-point grid of a device.
struct SampleGrid {
  int step_bits = 8;
  int steps = 256;            ///< a pixel: 2^step_bits
  std::vector<ivec2> places;  ///< of the samples, in steps from where pixel (0, 0) begins
  ivec2 lowest{0};            ///< of all places, each coordinate by itself
  ivec2 highest{0};
};

/// Where the samples stand on the grid that `snap` rounds to. At one sample, and always for
/// SwiftShader, the grid is shifted by half a pixel, so that pixel centres are whole.
///
/// @throws std::invalid_argument  samples is not 1, 2, 4 or 8.
SampleGrid sample_grid(int samples, Snapping snapping);

/// The grid point that a device rounds a vertex to, bit for bit: float arithmetic in the driver's
/// order.
///
/// @param clip  w > 0, |x / w| and |y / w| at most 65536 px / (half the size): inside the guard
///              band. What is farther out is held at 2^24 steps.
///
/// Source: conformance 1.4 (lp_setup_tri.c, draw_llvm.c of Mesa; VertexRoutine.cpp of SwiftShader).
ivec2 snap(vec4 clip, int width, int height, int samples, Snapping snapping);

}  // namespace parity::cpu
