#include "gpu/texture/displacement.h"

#include <stdexcept>
#include <string>

#include "gpu/core/buffer.h"
#include "gpu/core/commands.h"
#include "gpu/core/kernel.h"
#include "gpu/raster/prefix_sum.h"
#include "shaders.h"
#include "shaders/texture/layout.h"

namespace parity::gpu {
namespace {

std::vector<std::uint32_t> height_words(const Grid<u8vec4>& heights) {
  std::vector<std::uint32_t> words{3, std::uint32_t(heights.width()),
                                   std::uint32_t(heights.height())};
  for (const u8vec4& t : heights)
    words.push_back(std::uint32_t(t.x) | std::uint32_t(t.y) << 8 | std::uint32_t(t.z) << 16 |
                    std::uint32_t(t.w) << 24);
  return words;
}

std::vector<DisplacementVertex> vertices_of(const DisplacementProblem& problem) {
  if (problem.corners.size() % 3 != 0 || problem.heights.empty())
    throw std::invalid_argument("gpu::displace: " + std::to_string(problem.corners.size()) +
                                " corners and " + std::to_string(problem.heights.size()) +
                                " texels; must be threes, and some");
  std::vector<DisplacementVertex> vertices;
  for (const DisplacementCorner& c : problem.corners)
    vertices.push_back({c.position, c.normal, c.uv});
  return vertices;
}

}  // namespace

DisplacedMesh displace(Context& context, const DisplacementProblem& problem) {
  const Buffer<DisplacementVertex> vertices(context, vertices_of(problem));
  const auto count = std::uint32_t(vertices.count() / 3);
  const Buffer<std::uint32_t> heights(context, height_words(problem.heights));
  const Buffer<uvec4> factors(context, count);
  Buffer<std::uint32_t> begins(context, count + 1);  // the last: all
  const Kernel<DisplacementArgs> cut(context, shaders::texture_displacement_factors_comp);
  const Kernel<DisplacementArgs> move(context, shaders::texture_displacement_comp);
  PrefixSum prefix_sum(context, count + 1);
  DisplacementArgs args{
      problem.clip_from_world, heights,       vertices,           factors, begins, {},
      vec2(problem.size),      problem.scale, problem.max_pixels, count,   0};
  context.run([&](Commands& commands) {
    commands.fill(begins, 0);
    commands.dispatch(cut, {count}, args);
    prefix_sum.record(commands, begins, count + 1);
  });
  args.small_count = begins.read(count, 1)[0];
  const Buffer<vec3> corners(context, std::size_t(3) * args.small_count);
  args.corners = corners;
  context.run([&](Commands& commands) { commands.dispatch(move, {args.small_count}, args); });
  return {factors.read(), corners.read()};
}

}  // namespace parity::gpu
