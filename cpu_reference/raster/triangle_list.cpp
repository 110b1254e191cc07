#include "cpu_reference/raster/triangle_list.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace parity::cpu {
namespace {

constexpr int largest_side = 16384;

}  // namespace

void check_triangles(const TriangleList& list) {
  if (std::min(list.width, list.height) < 0 || std::max(list.width, list.height) > largest_side)
    throw std::invalid_argument("TriangleList: size is " + std::to_string(list.width) + "x" +
                                std::to_string(list.height) + ", must be within 0..16384");
  standard_sample_places(list.samples);
  for (std::size_t i = 0; i < list.triangles.size(); ++i) {
    const uvec3& t = list.triangles[i];
    const std::uint32_t largest = std::max({t.x, t.y, t.z});
    if (largest >= list.clip_positions.size())
      throw std::invalid_argument("TriangleList: triangle " + std::to_string(i) + " has vertex " +
                                  std::to_string(largest) + ", must be < " +
                                  std::to_string(list.clip_positions.size()));
  }
}

std::array<vec4, 3> corners_of(const TriangleList& list, std::uint32_t triangle) {
  const uvec3& t = list.triangles[triangle];
  return {list.clip_positions[t.x], list.clip_positions[t.y], list.clip_positions[t.z]};
}

}  // namespace parity::cpu
