#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>

#include "geometry/image_formats.h"
#include "geometry/input_error.h"

namespace parity::detail {
namespace {

struct PfmHeader {
  int channels = 3;
  int width = 0;
  int height = 0;
  bool big_endian = false;
  std::size_t size = 0;  ///< bytes before the samples
};

/// The next word, and the one white-space character behind it is passed.
std::string next_word(Bytes bytes, std::size_t& offset) {
  const auto is_space = [&](std::size_t i) { return std::isspace(int(bytes[i])) != 0; };
  while (offset < bytes.size() && is_space(offset)) ++offset;
  std::string word;
  while (offset < bytes.size() && !is_space(offset) && word.size() < 64)
    word += char(bytes[offset++]);
  ++offset;
  return word;
}

int parse_side(const std::string& word, const std::string& name) {
  int side = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), side);
  if (error != std::errc{} || end != word.data() + word.size())
    throw InputError(name, "bad PFM: size '" + word + "', expected a whole number");
  return side;
}

PfmHeader read_header(Bytes bytes, const std::string& name) {
  PfmHeader header;
  header.channels = next_word(bytes, header.size) == "PF" ? 3 : 1;
  header.width = parse_side(next_word(bytes, header.size), name);
  header.height = parse_side(next_word(bytes, header.size), name);
  const std::string word = next_word(bytes, header.size);
  double scale = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), scale);
  if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(scale) ||
      scale == 0)
    throw InputError(name, "bad PFM: scale '" + word + "', expected a number that is not 0");
  header.big_endian = scale > 0;
  return header;
}

float read_float(Bytes bytes, std::size_t offset, bool big_endian) {
  std::uint32_t bits = 0;
  for (int i = 0; i < 4; ++i)
    bits |= std::uint32_t(bytes[offset + std::size_t(i)]) << (8 * (big_endian ? 3 - i : i));
  return std::bit_cast<float>(bits);
}

}  // namespace

bool is_pfm(Bytes bytes) {
  return bytes.size() > 2 && (starts_with(bytes, "PF") || starts_with(bytes, "Pf")) &&
         std::isspace(int(bytes[2])) != 0;
}

Grid<vec4> decode_pfm(Bytes bytes, const std::string& name) {
  const PfmHeader header = read_header(bytes, name);
  check_claimed_size(name, header.width, header.height, bytes.size());
  const std::size_t texel_bytes = 4 * std::size_t(header.channels);
  const std::size_t want = texel_bytes * std::size_t(header.width) * std::size_t(header.height);
  const std::size_t have = bytes.size() - std::min(bytes.size(), header.size);
  if (have < want)
    throw InputError(name, "bad PFM: " + std::to_string(have) + " bytes of samples, expected " +
                               std::to_string(want));
  Grid<vec4> image{header.width, header.height};
  std::size_t offset = header.size;
  for (int row = header.height - 1; row >= 0; --row)
    for (int x = 0; x < header.width; ++x, offset += texel_bytes) {
      vec4& texel = image(x, row);
      texel = vec4(read_float(bytes, offset, header.big_endian));
      if (header.channels == 3) {
        texel.y = read_float(bytes, offset + 4, header.big_endian);
        texel.z = read_float(bytes, offset + 8, header.big_endian);
      }
      texel.w = 1.0f;
    }
  return image;
}

std::vector<std::byte> encode_pfm(const Grid<vec4>& linear) {
  const std::string header =
      "PF\n" + std::to_string(linear.width()) + " " + std::to_string(linear.height()) + "\n-1.0\n";
  std::vector<std::byte> bytes(header.size() + 12 * linear.size());
  std::memcpy(bytes.data(), header.data(), header.size());
  std::size_t offset = header.size();
  for (int row = linear.height() - 1; row >= 0; --row)
    for (int x = 0; x < linear.width(); ++x)
      for (int c = 0; c < 3; ++c) {
        const auto bits = std::bit_cast<std::uint32_t>(linear(x, row)[c]);
        for (int i = 0; i < 4; ++i) bytes[offset++] = std::byte(bits >> (8 * i));
      }
  return bytes;
}

}  // namespace parity::detail
