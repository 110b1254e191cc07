#include "cpu_reference/raster/painter.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

#include "cpu_reference/raster/interpolate.h"
#include "cpu_reference/raster/rasterize.h"
#include "cpu_reference/raster/triangle_list.h"

namespace parity::cpu {

std::vector<std::uint32_t> painter_order(std::span<const float> keys) {
  for (std::size_t i = 0; i < keys.size(); ++i)
    if (std::isnan(keys[i]))
      throw std::invalid_argument("cpu::painter_order: key " + std::to_string(i) + " is NaN");
  std::vector<std::uint32_t> order(keys.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return keys[a] > keys[b]; });
  return order;
}

std::vector<float> centroid_depths(const TriangleList& list) {
  check_triangles(list);
  std::vector<float> depths;
  depths.reserve(list.triangles.size());
  for (std::uint32_t i = 0; i < list.triangles.size(); ++i) {
    const std::array<vec4, 3> c = corners_of(list, i);
    const float z = (c[0].z + c[1].z) + c[2].z;
    const float w = (c[0].w + c[1].w) + c[2].w;
    depths.push_back(w > 0.0f ? z / w : -std::numeric_limits<float>::infinity());
  }
  return depths;
}

DepthImage painter(const TriangleList& list, Snapping snapping) {
  const std::vector<std::uint32_t> order = painter_order(centroid_depths(list));
  if (list.samples != 1)
    throw std::invalid_argument("cpu::painter: samples is " + std::to_string(list.samples) +
                                ", must be 1");
  TriangleList sorted = list;
  for (std::size_t i = 0; i < order.size(); ++i) sorted.triangles[i] = list.triangles[order[i]];
  const Coverage coverage = span_coverage(sorted, snapping);
  DepthImage image{{list.width, list.height, 1.0f}, {list.width, list.height, 0u}};
  for (int y = 0, pixel = 0; y < list.height; ++y)
    for (int x = 0; x < list.width; ++x, ++pixel) {
      const std::uint32_t last = coverage.last[std::size_t(pixel)];
      if (last == 0) continue;
      const TrianglePlanes planes =
          triangle_planes(corners_of(sorted, last - 1), list.width, list.height);
      image.front(x, y) = order[last - 1] + 1;
      image.depth(x, y) = float(std::clamp(planes.depth.at(x + 0.5, y + 0.5), 0.0, 1.0));
    }
  return image;
}

}  // namespace parity::cpu
