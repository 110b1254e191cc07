#include "gpu/sampling/area_coverage.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include "gpu/core/buffer.h"
#include "gpu/core/commands.h"
#include "gpu/core/kernel.h"
#include "shaders.h"
#include "shaders/sampling/layout.h"

namespace parity::gpu {
namespace {

constexpr std::uint32_t edges_a_dispatch = 16384;  // some devices cut long loops short

std::vector<vec4> edges_of(const Polygon& polygon) {
  std::vector<vec4> edges;
  for (const std::vector<vec2>& ring : polygon.rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const vec2 a = ring[i], b = ring[(i + 1) % ring.size()];
      if (!(std::max({std::abs(a.x), std::abs(a.y)}) <= 65536.0f))
        throw std::invalid_argument("gpu::area_coverage: a corner is (" + std::to_string(a.x) +
                                    ", " + std::to_string(a.y) + "), must be within 65536");
      if (a.y != b.y) edges.emplace_back(a, b);
    }
  return edges;
}

}  // namespace

Grid<float> area_coverage(Context& context, const Polygon& polygon, int width, int height) {
  if (width < 1 || height < 1 || width > 16384 || height > 16384)
    throw std::invalid_argument("gpu::area_coverage: size is " + std::to_string(width) + "x" +
                                std::to_string(height) + ", sides must be 1 to 16384");
  const std::vector<vec4> list = edges_of(polygon);
  const auto count = std::uint32_t(list.size());
  const Kernel<AreaCoverageArgs> kernel(context, shaders::sampling_area_coverage_comp);
  const Buffer<vec4> edges(context, list);
  Grid<float> result{width, height};
  const Buffer<float> areas(context, result.size());
  context.run([&](Commands& commands) {
    commands.fill(areas, 0);
    for (std::uint32_t first = 0; first < count; first += edges_a_dispatch)
      commands.dispatch(kernel, {std::uint32_t(width), std::uint32_t(height)},
                        AreaCoverageArgs{.edges = edges,
                                         .areas = areas,
                                         .width = std::uint32_t(width),
                                         .height = std::uint32_t(height),
                                         .first_edge = first,
                                         .last_edge = std::min(first + edges_a_dispatch, count)});
  });
  result.values() = areas.read();
  return result;
}

double area_coverage_bound(const Polygon& polygon, int width, int height) {
  double largest = std::max(width, height);
  double edges = 0;
  for (const std::vector<vec2>& ring : polygon.rings) {
    edges += double(ring.size());
    for (const vec2& p : ring)
      largest = std::max({largest, double(std::abs(p.x)), double(std::abs(p.y))});
  }
  return edges * (6 * largest + 1) * 0x1p-24;
}

}  // namespace parity::gpu
