#pragma once

#include <functional>
#include <vector>

#include "geometry/frame.h"
#include "geometry/grid.h"
#include "geometry/math.h"

namespace parity {

/// The share of the sky over each place of a picture, from its distances alone.
struct OcclusionProblem {
  Grid<float> distances;      ///< along the view, m, > 0; infinity: nothing is there
  vec2 slope{0.5f};           ///< half of the view's width and height at distance 1
  bool orthographic = false;  ///< then slope is half of the view's size, m
  float radius = 1;           ///< m; what is farther hides nothing
  std::vector<vec4> slices;   ///< slice_directions
  std::vector<float> parts;   ///< of the way to the radius that are looked at, ascending to 1
};

/// Where what hides the sky begins to count less, of the radius; at the radius it does not count.
constexpr float occlusion_fade = 0.7f;

/// Directions over half a turn along which texels lie on a line: all whole steps (x right, y down)
/// without common divisor of at most `order` on either axis; 4, 8, 16, 24, 40 for orders from 1. In
/// z the share of the half turn that is nearest to each, in w one over its length.
std::vector<vec4> slice_directions(int order);

/// ((i + 1) / steps)^2: closer together near the place itself.
std::vector<float> slice_parts(int steps);

struct OcclusionOptions {
  double radius = 0;  ///< m; 0: a tenth of the diagonal of the scene
  int order = 2;
  int steps = 8;
};

/// What cpu::ambient_occlusion and gpu::ambient_occlusion are asked to make Frame::openness of.
/// What is blended hides nothing.
///
/// @param depths_of  renders a frame and returns its depths.
/// @throws std::invalid_argument  a negative radius, an order outside 1..8, steps outside 1..64.
OcclusionProblem occlusion_problem(const Scene& scene, const Frame& frame,
                                   const OcclusionOptions& options,
                                   const std::function<Grid<float>(const Frame&)>& depths_of);

}  // namespace parity
