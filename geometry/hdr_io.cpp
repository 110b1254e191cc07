#include <charconv>
#include <cmath>
#include <cstring>
#include <string_view>

#include "geometry/image_formats.h"
#include "geometry/input_error.h"

namespace parity::detail {
namespace {

using Rgbe = u8vec4;

/// Reads a Radiance picture from front to back.
class HdrReader {
 public:
  HdrReader(Bytes bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  Grid<vec4> read() {
    read_header();
    read_size();
    Grid<vec4> image{width_, height_};
    std::vector<Rgbe> line(std::size_t(width_), Rgbe(0));
    for (int row = 0; row < height_; ++row) {
      read_line(line);
      for (int x = 0; x < width_; ++x)
        image(mirrored_ ? width_ - 1 - x : x, upward_ ? height_ - 1 - row : row) =
            decode(line[std::size_t(x)]);
    }
    return image;
  }

 private:
  [[noreturn]] void refuse(const std::string& what) const {
    throw InputError(name_, "bad HDR: " + what);
  }

  int next() {
    if (offset_ >= bytes_.size()) refuse("the file ends too early");
    return int(bytes_[offset_++]);
  }

  std::string next_text_line() {
    std::string line;
    for (int c = next(); c != '\n'; c = next()) {
      if (line.size() > 4096) refuse("a line of the header is longer than 4096 characters");
      line += char(c);
    }
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return line;
  }

  void read_header() {
    next_text_line();
    for (std::string line = next_text_line(); !line.empty(); line = next_text_line()) {
      if (line.starts_with("FORMAT=") && line != "FORMAT=32-bit_rle_rgbe")
        refuse("'" + line + "', expected FORMAT=32-bit_rle_rgbe");
      if (line.starts_with("EXPOSURE=")) exposure_ *= parse_exposure(line.substr(9));
    }
  }

  double parse_exposure(const std::string& text) const {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (end == text.c_str() || !std::isfinite(value) || value <= 0)
      refuse("EXPOSURE is '" + text + "', expected a number above 0");
    return value;
  }

  /// "-Y height +X width", or with either sign turned.
  void read_size() {
    const std::string line = next_text_line();
    char y_sign = 0, x_sign = 0;
    long long height = 0, width = 0;
    if (std::sscanf(line.c_str(), "%cY %lld %cX %lld", &y_sign, &height, &x_sign, &width) != 4 ||
        (y_sign != '-' && y_sign != '+') || (x_sign != '-' && x_sign != '+'))
      refuse("size '" + line + "', expected '-Y height +X width'");
    check_claimed_size(name_, width, height, bytes_.size());
    width_ = int(width);
    height_ = int(height);
    upward_ = y_sign == '+';
    mirrored_ = x_sign == '-';
  }

  void read_line(std::vector<Rgbe>& line) {
    const Rgbe first = next_texel();
    if (width_ >= 8 && width_ < 32768 && first.x == 2 && first.y == 2 && first.z < 128) {
      if (first.z * 256 + first.w != width_) refuse("a line's length is not the picture's width");
      for (int c = 0; c < 4; ++c) read_component(line, c);
    } else {
      read_flat_line(line, first);
    }
  }

  Rgbe next_texel() {
    Rgbe texel;
    for (int c = 0; c < 4; ++c) texel[c] = std::uint8_t(next());
    return texel;
  }

  void read_component(std::vector<Rgbe>& line, int c) {
    for (int x = 0; x < width_;) {
      const int code = next();
      const bool is_run = code > 128;
      const int count = is_run ? code - 128 : code;
      if (count == 0 || count > width_ - x) refuse("a run is empty or passes the end of its line");
      const int value = is_run ? next() : 0;
      for (int i = 0; i < count; ++i)
        line[std::size_t(x++)][c] = std::uint8_t(is_run ? value : next());
    }
  }

  /// Flat texels; (1, 1, 1, n) repeats the texel before it, further ones count in powers of 256.
  void read_flat_line(std::vector<Rgbe>& line, Rgbe texel) {
    int shift = 0;
    for (int x = 0;;) {
      if (texel.x == 1 && texel.y == 1 && texel.z == 1) {
        const long long count = (long long)(texel.w) << shift;
        if (x == 0 || count > width_ - x)
          refuse("a run has no start or passes the end of its line");
        for (long long i = 0; i < count; ++i, ++x) line[std::size_t(x)] = line[std::size_t(x - 1)];
        shift = std::min(shift + 8, 24);
      } else {
        line[std::size_t(x++)] = texel;
        shift = 0;
      }
      if (x == width_) return;
      texel = next_texel();
    }
  }

  vec4 decode(Rgbe texel) const {
    if (texel.w == 0) return {0.0f, 0.0f, 0.0f, 1.0f};
    const double unit = std::ldexp(1.0, texel.w - 136) / exposure_;
    return {float(texel.x * unit), float(texel.y * unit), float(texel.z * unit), 1.0f};
  }

  Bytes bytes_;
  std::string name_;
  std::size_t offset_ = 0;
  int width_ = 0;
  int height_ = 0;
  bool upward_ = false;
  bool mirrored_ = false;
  double exposure_ = 1.0;
};

Rgbe encode_texel(vec4 color) {
  double rgb[3];
  for (int c = 0; c < 3; ++c) rgb[c] = color[c] > 0 ? std::min(double(color[c]), 1.69e38) : 0.0;
  const double largest = std::max({rgb[0], rgb[1], rgb[2]});
  int exponent = 0;
  if (std::frexp(largest, &exponent) * 256.0 >= 255.5) ++exponent;
  if (largest == 0.0 || exponent + 128 <= 0) return Rgbe(0);
  Rgbe texel;
  for (int c = 0; c < 3; ++c)
    texel[c] = std::uint8_t(std::lround(std::ldexp(rgb[c], 8 - exponent)));
  texel.w = std::uint8_t(exponent + 128);
  return texel;
}

/// Runs of 3 to 127 equal values, and stretches of up to 128 unequal ones.
void append_component(std::vector<std::byte>& bytes, const std::vector<Rgbe>& line, int c) {
  const auto run_length = [&](std::size_t from) {
    std::size_t end = from + 1;
    while (end < line.size() && end - from < 127 && line[end][c] == line[from][c]) ++end;
    return end - from;
  };
  for (std::size_t x = 0; x < line.size();) {
    if (const std::size_t run = run_length(x); run >= 3) {
      bytes.push_back(std::byte(128 + run));
      bytes.push_back(std::byte(line[x][c]));
      x += run;
      continue;
    }
    std::size_t end = x;
    while (end < line.size() && end - x < 128 && run_length(end) < 3) ++end;
    bytes.push_back(std::byte(end - x));
    for (; x < end; ++x) bytes.push_back(std::byte(line[x][c]));
  }
}

void append_line(std::vector<std::byte>& bytes, const std::vector<Rgbe>& line) {
  const std::size_t width = line.size();
  if (width < 8) {  // flat: too short for runs
    for (const Rgbe& texel : line)
      for (int c = 0; c < 4; ++c) bytes.push_back(std::byte(texel[c]));
    return;
  }
  for (std::size_t value : {std::size_t(2), std::size_t(2), width >> 8, width & 255})
    bytes.push_back(std::byte(value));
  for (int c = 0; c < 4; ++c) append_component(bytes, line, c);
}

}  // namespace

bool is_hdr(Bytes bytes) { return starts_with(bytes, "#?"); }

Grid<vec4> decode_hdr(Bytes bytes, const std::string& name) {
  return HdrReader(bytes, name).read();
}

std::vector<std::byte> encode_hdr(const Grid<vec4>& linear) {
  const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " +
                             std::to_string(linear.height()) + " +X " +
                             std::to_string(linear.width()) + "\n";
  std::vector<std::byte> bytes(header.size());
  std::memcpy(bytes.data(), header.data(), header.size());
  std::vector<Rgbe> line(std::size_t(linear.width()));
  for (int y = 0; y < linear.height(); ++y) {
    for (int x = 0; x < linear.width(); ++x) line[std::size_t(x)] = encode_texel(linear(x, y));
    append_line(bytes, line);
  }
  return bytes;
}

}  // namespace parity::detail
