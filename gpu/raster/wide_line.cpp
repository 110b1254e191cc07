#include "gpu/raster/wide_line.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "gpu/core/commands.h"
#include "gpu/raster/edge_coverage.h"
#include "gpu/raster/hardware_draw.h"
#include "shaders.h"

namespace parity::gpu {
namespace {

/// Points of the window as clip positions, triangle after triangle.
TriangleList window_triangles(const std::vector<vec2>& points, ivec2 size) {
  TriangleList list{.width = size.x,
                    .height = size.y,
                    .samples = 1,
                    .clip_positions = {},
                    .triangles = {},
                    .cull = Cull::none};
  for (const vec2& p : points)
    list.clip_positions.emplace_back(2 * p.x / float(size.x) - 1, 2 * p.y / float(size.y) - 1, 0,
                                     1);
  for (std::uint32_t t = 0; t + 2 < points.size(); t += 3)
    list.triangles.emplace_back(t, t + 1, t + 2);
  return list;
}

Grid<std::uint8_t> mask_of(const std::vector<std::uint32_t>& counts, ivec2 size) {
  Grid<std::uint8_t> mask{size.x, size.y};
  for (std::size_t i = 0; i < counts.size(); ++i) mask.values()[i] = counts[i] != 0 ? 1 : 0;
  return mask;
}

}  // namespace

Grid<std::uint8_t> wide_line(Context& context, vec2 begin, vec2 end, float line_width, ivec2 size) {
  const dvec2 along = dvec2(end) - dvec2(begin);
  const double length = glm::length(along);
  if (!(length > 0) || !(line_width > 0))
    throw std::invalid_argument("gpu::wide_line: length is " + std::to_string(length) +
                                ", line_width is " + std::to_string(line_width) +
                                ", both must be positive");
  const vec2 aside = vec2(dvec2(-along.y, along.x) * (0.5 * line_width / length));
  const vec2 a = begin - aside, b = end - aside, c = end + aside, d = begin + aside;
  const TriangleList list = window_triangles({a, b, c, a, c, d}, size);
  return mask_of(edge_coverage(context, list, Snapping::mesa).count, size);
}

Grid<std::uint8_t> hardware_line(Context& context, vec2 begin, vec2 end, LineRule rule,
                                 ivec2 size) {
  const TriangleBuffers points(context, window_triangles({begin, end, end}, size),
                               "gpu::hardware_line");
  const RasterPipeline<DrawArgs> pipeline(context, shaders::raster_draw_vert,
                                          shaders::raster_hardware_line_frag,
                                          {.colors = {Format::r32_uint},
                                           .blends = {},
                                           .depth = {},
                                           .primitive = gpu::Primitive::lines,
                                           .line_rule = rule,
                                           .specializations = {}});
  const Image image(context, {.width = size.x, .height = size.y, .format = Format::r32_uint});
  const Buffer<std::uint32_t> covered(context, std::size_t(size.x) * std::size_t(size.y));
  context.run([&](Commands& commands) {
    commands.render({.colors = {cleared(image)}, .depth = {}},
                    [&](RenderPass& pass) { pass.draw(pipeline, draw_args(points), 2); });
    commands.copy(image, covered);
  });
  return mask_of(covered.read(), size);
}

}  // namespace parity::gpu
