#include "gpu/raster/line_pixels.h"

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

#include "gpu/core/commands.h"
#include "shaders/raster/layout.h"

namespace parity::gpu {
namespace {

constexpr int greatest_coordinate = 1 << 20;
constexpr int greatest_side = 60000;

std::uint32_t pixel_count(const Segment& segment, const char* who) {
  for (const ivec2& end : {segment.begin, segment.end})
    for (const int x : {end.x, end.y})
      if (x < -greatest_coordinate || x > greatest_coordinate)
        throw std::invalid_argument(std::string(who) + ": a coordinate is " + std::to_string(x) +
                                    ", must be within 2^20");
  const ivec2 d = segment.end - segment.begin;
  const int side = std::max(std::abs(d.x), std::abs(d.y));
  if (side > greatest_side)
    throw std::invalid_argument(std::string(who) + ": a side is " + std::to_string(side) +
                                " pixels, must be at most 60000");
  return std::uint32_t(side) + 1;
}

}  // namespace

std::vector<std::vector<ivec2>> line_pixels(Context& context, const ShaderCode& code,
                                            std::span<const Segment> segments, const char* who) {
  std::vector<std::uint32_t> offsets{0};
  std::vector<ivec4> ends;
  for (const Segment& segment : segments) {
    offsets.push_back(offsets.back() + pixel_count(segment, who));
    ends.emplace_back(segment.begin, segment.end);
  }
  const Buffer<ivec4> segment_buffer(context, ends);
  const Buffer<std::uint32_t> offset_buffer(context, offsets);
  const Buffer<ivec2> pixels(context, offsets.back());
  const Kernel<LineArgs> kernel(context, code);
  const auto count = std::uint32_t(segments.size());
  context.run([&](Commands& commands) {
    commands.dispatch(kernel, {count}, {segment_buffer, offset_buffer, pixels, count, 0});
  });
  const std::vector<ivec2> all = pixels.read();
  std::vector<std::vector<ivec2>> lines;
  for (std::size_t i = 0; i < segments.size(); ++i)
    lines.emplace_back(all.begin() + offsets[i], all.begin() + offsets[i + 1]);
  return lines;
}

}  // namespace parity::gpu
