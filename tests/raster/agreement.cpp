#include "tests/raster/agreement.h"

#include <cmath>

namespace parity::raster_test {
namespace {

/// Largest difference of a channel over its bound; not finite counts as infinite.
double color_distance(const vec4& got, const vec4& want, const vec4& bound) {
  double worst = 0;
  for (int c = 0; c < 4; ++c) {
    const double apart = std::abs(double(got[c]) - double(want[c]));
    if (apart == 0) continue;
    const double in_bounds = apart / double(bound[c]);
    if (!(in_bounds < 1e30)) return 1e30;
    worst = std::max(worst, in_bounds);
  }
  return worst;
}

/// Our shaders filter textures themselves, in single precision.
cpu::DeviceLimits limits_of(const gpu::DeviceInfo& device) {
  cpu::DeviceLimits limits;
  limits.sub_pixel_bits = device.subpixel_bits;
  limits.half_color = false;
  return limits;
}

}  // namespace

std::string Agreement::text() const {
  return std::to_string(wrong()) + " of " + std::to_string(pixels) + " pixels: coverage " +
         std::to_string(coverage) + ", depth " + std::to_string(depth) + ", colour " +
         std::to_string(color) + "; ambiguous " + std::to_string(ambiguous) + "; worst colour " +
         std::to_string(worst) + " bounds; first at (" + std::to_string(first.x) + ", " +
         std::to_string(first.y) + ")";
}

Agreement compare(const Picture& got, const cpu::Rendered& want) {
  Agreement a;
  a.pixels = want.picture.color.size();
  for (int y = 0; y < want.picture.color.height(); ++y)
    for (int x = 0; x < want.picture.color.width(); ++x) {
      if (want.ambiguous(x, y)) {
        ++a.ambiguous;
        continue;
      }
      const std::uint32_t g = got.element(x, y);
      const std::uint32_t w = want.picture.element(x, y);
      const float depth_apart = std::abs(got.depth(x, y) - want.picture.depth(x, y));
      const double color =
          color_distance(got.color(x, y), want.picture.color(x, y), want.color_bound(x, y));
      const std::size_t before = a.wrong();
      if ((g == 0) != (w == 0))
        ++a.coverage;
      else if (g != w || !(depth_apart <= want.depth_bound(x, y)))
        ++a.depth;
      else if (color > 1)
        ++a.color;
      if (g == w) a.worst = std::max(a.worst, color);
      if (before == 0 && a.wrong() > 0) a.first = {x, y};
    }
  return a;
}

Agreement draw_and_compare(gpu::Context& context, const Scene& scene, const Frame& frame) {
  const Picture got = gpu::render(context, scene, frame, {.elements = true, .full_float = true});
  const Snapping snapping = context.info().is_swiftshader ? Snapping::swiftshader : Snapping::mesa;
  const cpu::Rendered want = cpu::render(scene, frame,
                                         {.snapping = snapping,
                                          .elements = true,
                                          .bounds = true,
                                          .device = limits_of(context.info())});
  return compare(got, want);
}

}  // namespace parity::raster_test
