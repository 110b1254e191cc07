#include "gpu/raster/dda_line.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include "gpu/core/commands.h"
#include "gpu/raster/edge_coverage.h"
#include "gpu/raster/hardware_draw.h"
#include "gpu/raster/line_pixels.h"
#include "shaders.h"

namespace parity::gpu {
namespace {

/// Points of the window as clip positions, triangle after triangle.
TriangleList window_triangles(const std::vector<vec2>& points, int width, int height) {
  TriangleList list{.width = width,
                    .height = height,
                    .samples = 1,
                    .clip_positions = {},
                    .triangles = {},
                    .cull = Cull::none};
  for (const vec2& p : points)
    list.clip_positions.emplace_back(2 * p.x / float(width) - 1, 2 * p.y / float(height) - 1, 0, 1);
  for (std::uint32_t t = 0; t + 2 < points.size(); t += 3)
    list.triangles.emplace_back(t, t + 1, t + 2);
  return list;
}

Grid<std::uint8_t> mask_of(const std::vector<std::uint32_t>& counts, int width, int height) {
  Grid<std::uint8_t> mask{width, height};
  for (std::size_t i = 0; i < counts.size(); ++i) mask.values()[i] = counts[i] != 0 ? 1 : 0;
  return mask;
}

}  // namespace

std::vector<std::vector<ivec2>> dda_line(Context& context, std::span<const Segment> segments) {
  return line_pixels(context, shaders::raster_dda_line_comp, segments, "gpu::dda_line");
}

Grid<std::uint8_t> wide_line(Context& context, vec2 begin, vec2 end, float line_width, int width,
                             int height) {
  const dvec2 along = dvec2(end) - dvec2(begin);
  const double length = glm::length(along);
  if (!(length > 0) || !(line_width > 0))
    throw std::invalid_argument("gpu::wide_line: length is " + std::to_string(length) +
                                ", line_width is " + std::to_string(line_width) +
                                ", both must be positive");
  const vec2 aside = vec2(dvec2(-along.y, along.x) * (0.5 * line_width / length));
  const vec2 a = begin - aside, b = end - aside, c = end + aside, d = begin + aside;
  const TriangleList list = window_triangles({a, b, c, a, c, d}, width, height);
  return mask_of(edge_coverage(context, list, Snapping::mesa).count, width, height);
}

Grid<std::uint8_t> hardware_line(Context& context, vec2 begin, vec2 end, int width, int height) {
  const TriangleBuffers points(context, window_triangles({begin, end, end}, width, height),
                               "gpu::hardware_line");
  const RasterPipeline<DrawArgs> pipeline(context, shaders::raster_draw_vert,
                                          shaders::raster_hardware_line_frag,
                                          {.colors = {Format::r32_uint},
                                           .blends = {},
                                           .depth = {},
                                           .primitive = gpu::Primitive::lines,
                                           .specializations = {}});
  const Image image(context, {.width = width, .height = height, .format = Format::r32_uint});
  const Buffer<std::uint32_t> covered(context, std::size_t(width) * std::size_t(height));
  context.run([&](Commands& commands) {
    commands.render({.colors = {cleared(image)}, .depth = {}},
                    [&](RenderPass& pass) { pass.draw(pipeline, draw_args(points), 2); });
    commands.copy(image, covered);
  });
  return mask_of(covered.read(), width, height);
}

}  // namespace parity::gpu
