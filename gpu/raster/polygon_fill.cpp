#include "gpu/raster/polygon_fill.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "gpu/core/commands.h"
#include "shaders.h"
#include "shaders/raster/layout.h"

namespace parity::gpu {
namespace {

std::vector<vec4> sides_of(const Polygon& polygon) {
  std::vector<vec4> sides;
  for (const std::vector<vec2>& ring : polygon.rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      if (!(std::abs(ring[i].x) <= 16777216.0f && std::abs(ring[i].y) <= 16777216.0f))
        throw std::invalid_argument("gpu::polygon_fill: a corner is (" + std::to_string(ring[i].x) +
                                    ", " + std::to_string(ring[i].y) + "), must be within 2^24");
      sides.emplace_back(ring[i], ring[(i + 1) % ring.size()]);
    }
  if (sides.size() > 60000)
    throw std::invalid_argument("gpu::polygon_fill: there are " + std::to_string(sides.size()) +
                                " sides, must be at most 60000");
  return sides;
}

}  // namespace

Grid<std::uint8_t> polygon_fill(Context& context, const Polygon& polygon, FillRule rule, int width,
                                int height) {
  if (width < 1 || width > 16384 || height < 1 || height > 16384)
    throw std::invalid_argument("gpu::polygon_fill: size is " + std::to_string(width) + "x" +
                                std::to_string(height) + ", sides must be 1 to 16384");
  const Buffer<vec4> sides(context, sides_of(polygon));
  const Buffer<std::uint32_t> inside(context, std::size_t(width) * std::size_t(height));
  const Kernel<PolygonArgs> kernel(context, shaders::raster_polygon_fill_comp);
  context.run([&](Commands& commands) {
    commands.dispatch(kernel, {std::uint32_t(inside.count())},
                      {sides, inside, std::uint32_t(sides.count()), std::uint32_t(width),
                       std::uint32_t(height), std::uint32_t(rule)});
  });
  const std::vector<std::uint32_t> values = inside.read();
  Grid<std::uint8_t> mask{width, height};
  mask.values().assign(values.begin(), values.end());
  return mask;
}

}  // namespace parity::gpu
