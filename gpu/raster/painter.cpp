#include "gpu/raster/painter.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "gpu/core/commands.h"
#include "gpu/raster/edge_coverage.h"
#include "gpu/raster/interpolate.h"
#include "gpu/raster/triangle_buffers.h"
#include "shaders.h"

namespace parity::gpu {
namespace {

void refuse_nan(std::span<const float> keys, const char* who) {
  for (std::size_t i = 0; i < keys.size(); ++i)
    if (std::isnan(keys[i]))
      throw std::invalid_argument(std::string(who) + ": key " + std::to_string(i) +
                                  " is NaN, must be a number");
}

std::vector<float> mean_depths(Context& context, const TriangleBuffers& triangles) {
  const Buffer<float> keys(context, triangles.triangle_count());
  const Kernel<PainterKeyArgs> kernel(context, shaders::raster_painter_key_comp);
  context.run([&](Commands& commands) {
    commands.dispatch(kernel, {triangles.triangle_count()}, {triangles.source(), keys});
  });
  return keys.read();
}

}  // namespace

PainterOrder::PainterOrder(Context& context, std::uint32_t capacity)
    : capacity_(capacity),
      keys_of_(context, shaders::raster_float_key_comp),
      sort_(context, capacity),
      count_(context, 1),
      keys_(context, capacity),
      values_(context, capacity) {}

void PainterOrder::record(Commands& commands, BufferRef<float> depths, std::uint32_t count) {
  if (count > capacity_)
    throw std::invalid_argument("PainterOrder::record: count is " + std::to_string(count) +
                                ", capacity is " + std::to_string(capacity_));
  if (count == 0) return;
  commands.fill(count_, count);
  commands.dispatch(keys_of_, {count}, {depths, keys_, values_, count, 0});
  sort_.record(commands, count_, keys_, values_, 32);
}

std::vector<std::uint32_t> painter_order(Context& context, std::span<const float> keys) {
  refuse_nan(keys, "gpu::painter_order");
  const Buffer<float> depths(context, keys);
  const auto count = std::uint32_t(keys.size());
  PainterOrder sorter(context, count);
  context.run([&](Commands& commands) { sorter.record(commands, depths, count); });
  return sorter.order().read();
}

DepthImage painter(Context& context, const TriangleList& list) {
  const TriangleBuffers triangles(context, list, "gpu::painter");
  const std::vector<std::uint32_t> order = painter_order(context, mean_depths(context, triangles));
  TriangleList sorted = list;
  sorted.samples = 1;
  for (std::size_t i = 0; i < order.size(); ++i) sorted.triangles[i] = list.triangles[order[i]];
  const Coverage coverage = edge_coverage(context, sorted, Snapping::mesa);
  const Grid<vec4> clip = interpolate(
      context, sorted, {.values = list.clip_positions, .perspective = true}, Snapping::mesa);
  DepthImage image{Grid<float>{list.width, list.height, 1.0f},
                   Grid<std::uint32_t>{list.width, list.height, 0u}};
  for (std::size_t i = 0; i < coverage.last.size(); ++i)
    if (coverage.last[i] != 0) {
      image.front.values()[i] = 1 + order[coverage.last[i] - 1];
      image.depth.values()[i] = clip.values()[i].z / clip.values()[i].w;
    }
  return image;
}

}  // namespace parity::gpu
