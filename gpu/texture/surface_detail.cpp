#include "gpu/texture/surface_detail.h"

#include <stdexcept>
#include <string>

#include "gpu/core/buffer.h"
#include "gpu/core/commands.h"
#include "gpu/core/kernel.h"
#include "shaders.h"

namespace parity::gpu {
namespace {

std::vector<vec3> without_w(const Buffer<vec4>& values) {
  std::vector<vec3> result;
  for (const vec4& value : values.read()) result.emplace_back(value);
  return result;
}

std::vector<vec3> normals(Context& context, std::span<const SurfaceDetail> details,
                          std::uint32_t kind) {
  const Buffer<SurfaceDetail> in(context, details);
  const Buffer<vec4> out(context, details.size());
  const Kernel<SurfaceDetailArgs> kernel(context, shaders::texture_surface_detail_comp);
  const auto count = std::uint32_t(details.size());
  context.run([&](Commands& commands) {
    commands.dispatch(kernel, {count}, {in, out, count, kind});
  });
  return without_w(out);
}

}  // namespace

std::vector<vec3> bump(Context& context, std::span<const SurfaceDetail> details) {
  return normals(context, details, 0);
}

std::vector<vec3> normal_map(Context& context, std::span<const SurfaceDetail> details) {
  return normals(context, details, 1);
}

std::vector<vec3> parallax(Context& context, const Grid<u8vec4>& heights,
                           std::span<const ParallaxRay> rays, float scale, int layers) {
  if (heights.empty() || layers < 1 || layers > 1024)
    throw std::invalid_argument("gpu::parallax: " + std::to_string(heights.size()) + " texels, " +
                                std::to_string(layers) + " layers; must be some, and 1 to 1024");
  std::vector<std::uint32_t> words{1};  // where the level begins
  for (const u8vec4& t : heights)
    words.push_back(std::uint32_t(t.x) | std::uint32_t(t.y) << 8 | std::uint32_t(t.z) << 16 |
                    std::uint32_t(t.w) << 24);
  const Buffer<std::uint32_t> texels(context, words);
  const Buffer<ParallaxRay> in(context, rays);
  const Buffer<vec4> hits(context, rays.size());
  const Kernel<ParallaxArgs> kernel(context, shaders::texture_parallax_comp);
  const auto count = std::uint32_t(rays.size());
  context.run([&](Commands& commands) {
    commands.dispatch(kernel, {count},
                      {texels,
                       {},
                       in,
                       hits,
                       std::uint32_t(heights.width()),
                       std::uint32_t(heights.height()),
                       std::uint32_t(layers),
                       count,
                       scale,
                       0});
  });
  return without_w(hits);
}

}  // namespace parity::gpu
