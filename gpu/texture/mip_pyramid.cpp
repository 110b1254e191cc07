#include "gpu/texture/mip_pyramid.h"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

#include "geometry/mip_pyramid.h"
#include "shaders.h"

namespace parity::gpu {
namespace {

constexpr std::uint32_t srgb_constant = 0, from_codes_constant = 1;

std::size_t texels_of(const MipLevel& level) {
  return std::size_t(level.width) * std::size_t(level.height);
}

template <typename T>
BufferRef<T> at(BufferRef<std::uint32_t> codes, std::size_t texel) {
  return {codes.address + texel * sizeof(std::uint32_t)};
}

/// Sides that three levels can be made of at once.
bool makes_triples(const MipLevel& level) { return level.width % 8 == 0 && level.height % 8 == 0; }

}  // namespace

MipPyramid::MipPyramid(Context& context)
    : linear_triple_(context, shaders::texture_mip_pyramid_comp, {{srgb_constant, 0}}),
      srgb_triple_(context, shaders::texture_mip_pyramid_comp, {{srgb_constant, 1}}),
      linear_first_(context, shaders::texture_mip_level_comp,
                    {{srgb_constant, 0}, {from_codes_constant, 1}}),
      srgb_first_(context, shaders::texture_mip_level_comp,
                  {{srgb_constant, 1}, {from_codes_constant, 1}}),
      linear_next_(context, shaders::texture_mip_level_comp,
                   {{srgb_constant, 0}, {from_codes_constant, 0}}),
      srgb_next_(context, shaders::texture_mip_level_comp,
                 {{srgb_constant, 1}, {from_codes_constant, 0}}) {}

MipPyramid::Scratch::Scratch(Context& context, int width, int height) {
  const std::vector<MipLevel> levels = mip_levels(width, height);
  const auto room = [&](std::size_t level) {
    return level < levels.size() ? texels_of(levels[level]) : 0;
  };
  const bool triples = makes_triples(levels[0]);
  odd = Buffer<vec4>(context, triples ? room(3) : room(1));
  even = Buffer<vec4>(context, triples ? room(4) : room(2));
}

void MipPyramid::record(Commands& commands, BufferRef<std::uint32_t> codes, int width, int height,
                        bool srgb, const Scratch& scratch, std::size_t count) const {
  const bool triples = makes_triples(mip_levels(width, height)[0]);
  if (triples) record_rows(commands, codes, 0, height, codes, width, height, srgb, scratch);
  record_below(commands, triples ? 4 : 1, codes, width, height, srgb, scratch, count);
}

void MipPyramid::record_rows(Commands& commands, BufferRef<std::uint32_t> rows, int first,
                             int count, BufferRef<std::uint32_t> codes, int width, int height,
                             bool srgb, const Scratch& scratch) const {
  const std::vector<MipLevel> levels = mip_levels(width, height);
  const auto place = [&](std::size_t level) {
    return std::size_t(first >> level) * std::size_t(levels[level].width);
  };
  commands.dispatch(srgb ? srgb_triple_ : linear_triple_,
                    {std::uint32_t((count / 8) * (width / 8))},
                    {at<uvec4>(rows, 0), at<uvec2>(codes, levels[1].first + place(1)),
                     at<std::uint32_t>(codes, levels[2].first + place(2)),
                     at<std::uint32_t>(codes, levels[3].first + place(3)),
                     scratch.odd.ref(place(3)), std::uint32_t(width), std::uint32_t(count)});
}

void MipPyramid::record_below(Commands& commands, std::size_t next, BufferRef<std::uint32_t> codes,
                              int width, int height, bool srgb, const Scratch& scratch,
                              std::size_t count) const {
  const std::vector<MipLevel> levels = mip_levels(width, height);
  const std::size_t end = std::min(levels.size(), count);
  const auto means = [&](std::size_t level) -> BufferRef<vec4> {
    return level % 2 == 0 ? scratch.even : scratch.odd;
  };
  for (; next < end; ++next) {
    const MipLevel& above = levels[next - 1];
    const MipLevel& level = levels[next];
    const Kernel<MipLevelArgs>& kernel =
        next == 1 ? (srgb ? srgb_first_ : linear_first_) : (srgb ? srgb_next_ : linear_next_);
    commands.dispatch(
        kernel, {std::uint32_t(texels_of(level))},
        {at<std::uint32_t>(codes, above.first), means(next - 1),
         at<std::uint32_t>(codes, level.first), means(next), std::uint32_t(above.width),
         std::uint32_t(above.height), std::uint32_t(level.width), std::uint32_t(level.height)});
  }
}

namespace {

/// Texels that are on the device at a time of a level 0 that is not kept.
constexpr int band_texels = 1 << 18;

/// Levels first..last of an image, behind room for the head; level 0 only in bands of rows.
Buffer<std::uint32_t> build_in_bands(Context& context, const MipPyramid& pyramid,
                                     const Grid<u8vec4>& image, bool srgb, PyramidRoom room,
                                     const std::vector<MipLevel>& levels) {
  const int width = image.width(), height = image.height();
  const int most = std::min(std::max(band_texels / width / 8, 1) * 8, height);
  const std::size_t begin = levels[1].first;
  const std::size_t made = std::max<std::size_t>(room.last, 3);
  const Buffer<std::uint32_t> lower(context, levels[made].first + texels_of(levels[made]) - begin);
  // As if level 0 lay before it.
  const BufferRef<std::uint32_t> codes{lower.ref().address - begin * sizeof(std::uint32_t)};
  const MipPyramid::Scratch scratch(context, width, height);
  {
    Buffer<std::uint32_t> band(context, std::size_t(most) * std::size_t(width));
    std::vector<std::uint32_t> rows;
    for (int first = 0; first < height; first += most) {
      const int count = std::min(most, height - first);
      rows.resize(std::size_t(count) * std::size_t(width));
      std::memcpy(rows.data(), image.data() + std::size_t(first) * std::size_t(width),
                  rows.size() * sizeof(std::uint32_t));
      band.write(rows);
      context.run([&](Commands& commands) {
        pyramid.record_rows(commands, band, first, count, codes, width, height, srgb, scratch);
      });
    }
  }
  const std::size_t from = levels[room.first].first;
  const std::size_t count = levels[room.last].first + texels_of(levels[room.last]) - from;
  Buffer<std::uint32_t> kept(context, room.head + count);
  context.run([&](Commands& commands) {
    pyramid.record_below(commands, 4, codes, width, height, srgb, scratch, room.last + 1);
    commands.copy(lower, kept, from - begin, room.head, count);
  });
  return kept;
}

}  // namespace

Buffer<std::uint32_t> build_pyramid(Context& context, const MipPyramid& pyramid,
                                    const Grid<u8vec4>& image, bool srgb, PyramidRoom room) {
  if (image.empty()) throw std::invalid_argument("gpu::mip_pyramid: the image is empty");
  const std::vector<MipLevel> levels = mip_levels(image.width(), image.height());
  if (room.first > room.last || room.first >= levels.size())
    throw std::invalid_argument("gpu::mip_pyramid: levels " + std::to_string(room.first) + " to " +
                                std::to_string(room.last) + " of " + std::to_string(levels.size()));
  const std::size_t last = std::min(room.last, levels.size() - 1);
  if (room.first > 0 && makes_triples(levels[0]))
    return build_in_bands(context, pyramid, image, srgb, {room.head, room.first, last}, levels);
  // Three levels are made at once.
  const MipLevel& made =
      levels[last == 0 ? 0 : std::min(std::max<std::size_t>(last, 3), levels.size() - 1)];
  const std::size_t head = room.first == 0 ? room.head : 0;
  Buffer<std::uint32_t> codes(context, head + made.first + texels_of(made));
  std::vector<std::uint32_t> level(image.size());
  std::memcpy(level.data(), image.data(), image.size() * sizeof(std::uint32_t));
  codes.write(level, head);
  if (last == 0) return codes;
  const MipPyramid::Scratch scratch(context, image.width(), image.height());
  const std::size_t begin = levels[room.first].first;
  const std::size_t count = levels[last].first + texels_of(levels[last]) - begin;
  Buffer<std::uint32_t> kept;
  if (room.first > 0) kept = Buffer<std::uint32_t>(context, room.head + count);
  context.run([&](Commands& commands) {
    pyramid.record(commands, codes.ref(head), image.width(), image.height(), srgb, scratch,
                   last + 1);
    if (room.first > 0) commands.copy(codes, kept, begin, room.head, count);
  });
  return room.first > 0 ? std::move(kept) : std::move(codes);
}

std::vector<Grid<u8vec4>> mip_pyramid(Context& context, const Grid<u8vec4>& image, bool srgb) {
  const std::vector<MipLevel> levels = mip_levels(image.width(), image.height());
  const std::vector<std::uint32_t> words =
      build_pyramid(context, MipPyramid(context), image, srgb, {}).read();
  std::vector<Grid<u8vec4>> pyramid;
  for (const MipLevel& level : levels) {
    Grid<u8vec4>& codes = pyramid.emplace_back(level.width, level.height);
    std::memcpy(codes.data(), words.data() + level.first, codes.size() * sizeof(std::uint32_t));
  }
  return pyramid;
}

}  // namespace parity::gpu
