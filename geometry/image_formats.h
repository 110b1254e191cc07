#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "geometry/grid.h"
#include "geometry/image_io.h"
#include "geometry/math.h"

/// One pair of functions a picture format; image_io.h chooses among them.
namespace parity::detail {

using Bytes = std::span<const std::byte>;
using u16vec4 = glm::u16vec4;

constexpr int max_image_side = 16384;

/// Refuses a size that a header claims before anything is allocated for it: a side that is 0 or
/// above 16384, or (beyond 2^24 texels) more than 4096 texels a byte of the file, which no format
/// reaches with a picture in it.
///
/// @throws InputError
void check_claimed_size(const std::string& name, std::int64_t width, std::int64_t height,
                        std::size_t file_bytes);

/// Starts with these characters?
inline bool starts_with(Bytes bytes, std::string_view magic) {
  return bytes.size() >= magic.size() &&
         std::equal(magic.begin(), magic.end(), bytes.begin(),
                    [](char c, std::byte b) { return std::byte(c) == b; });
}

bool is_png(Bytes bytes);
bool is_16_bit_png(Bytes bytes);
Grid<u8vec4> decode_png_8(Bytes bytes, const std::string& name);
Grid<u16vec4> decode_png_16(Bytes bytes, const std::string& name);
std::vector<std::byte> encode_png(const Grid<u8vec4>& texels);

bool is_jpeg(Bytes bytes);
Grid<u8vec4> decode_jpeg(Bytes bytes, const std::string& name);

bool is_exr(Bytes bytes);
Grid<vec4> decode_exr(Bytes bytes, const std::string& name);
std::vector<std::byte> encode_exr(const Grid<vec4>& linear, const ImageMetadata& metadata);

bool is_hdr(Bytes bytes);
Grid<vec4> decode_hdr(Bytes bytes, const std::string& name);
std::vector<std::byte> encode_hdr(const Grid<vec4>& linear);

bool is_pfm(Bytes bytes);
Grid<vec4> decode_pfm(Bytes bytes, const std::string& name);
std::vector<std::byte> encode_pfm(const Grid<vec4>& linear);

}  // namespace parity::detail
