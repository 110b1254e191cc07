#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/raster.h"

namespace parity::cpu {

/// The order from the greatest key to the smallest; equal keys stay in their order.
///
/// @return  indices into keys.
/// @throws std::invalid_argument  a key is NaN.
///
/// Source: notes 1.7.
std::vector<std::uint32_t> painter_order(std::span<const float> keys);

/// The depth z / w (0 near) of each triangle's centroid. Float, in this order, because an order
/// depends on it: ((z0 + z1) + z2) / ((w0 + w1) + w2). A centroid behind the eye counts as nearest,
/// minus infinity.
std::vector<float> centroid_depths(const TriangleList& list);

/// What is in front at each pixel centre if the triangles are painted over one another from far to
/// near, by the depth of their centroids. Depth is that of the triangle that was painted last, 1
/// where nothing is. Wrong where triangles intersect or overlap in a cycle.
///
/// @param list  at 1 sample, standard depth.
/// @throws std::invalid_argument  as check_triangles; samples not 1.
///
/// Source: notes 1.7.
DepthImage painter(const TriangleList& list, Snapping snapping);

}  // namespace parity::cpu
