#include "geometry/image_io.h"

#include <cmath>
#include <stdexcept>

#include "geometry/atomic_file.h"
#include "geometry/color.h"
#include "geometry/image_formats.h"
#include "geometry/input_error.h"

namespace parity {
namespace {

template <typename Texel>
Grid<vec4> decoded_from_srgb(const Grid<Texel>& texels, double largest) {
  std::vector<float> table(std::size_t(largest) + 1);
  for (std::size_t i = 0; i < table.size(); ++i)
    table[i] = float(linear_from_srgb(double(i) / largest));
  Grid<vec4> linear{texels.width(), texels.height()};
  std::transform(texels.begin(), texels.end(), linear.begin(), [&](const Texel& t) {
    return vec4(table[t.x], table[t.y], table[t.z], float(double(t.w) / largest));
  });
  return linear;
}

std::uint8_t byte_from_unit(double value) {
  return std::isnan(value) ? std::uint8_t(0)
                           : std::uint8_t(std::lround(std::clamp(value, 0.0, 1.0) * 255.0));
}

void check_can_be_saved(int width, int height) {
  if (width < 1 || height < 1 || width > detail::max_image_side || height > detail::max_image_side)
    throw std::invalid_argument("save_image: size is " + std::to_string(width) + "x" +
                                std::to_string(height) + ", must be 1x1 to 16384x16384");
}

void check_channels(const Grid<vec4>& linear, const ImageMetadata& metadata) {
  for (const ImageChannel& channel : metadata.channels)
    if (channel.values.width() != linear.width() || channel.values.height() != linear.height())
      throw std::invalid_argument("save_image: channel " + channel.name +
                                  " differs in size from the picture");
}

}  // namespace

namespace detail {

void check_claimed_size(const std::string& name, std::int64_t width, std::int64_t height,
                        std::size_t file_bytes) {
  const std::string size = std::to_string(width) + "x" + std::to_string(height);
  if (width < 1 || height < 1 || width > max_image_side || height > max_image_side)
    throw InputError(name, "the picture's size is " + size + ", expected 1x1 to 16384x16384");
  const std::int64_t texels = width * height;
  if (texels > (1 << 24) && std::size_t(texels) / 4096 > file_bytes)
    throw InputError(name, "the picture's size is " + size + ", more than a file of " +
                               std::to_string(file_bytes) + " bytes can hold");
}

}  // namespace detail

Grid<u8vec4> decode_image(std::span<const std::byte> bytes, const std::string& name) {
  if (detail::is_png(bytes)) return detail::decode_png_8(bytes, name);
  if (detail::is_jpeg(bytes)) return detail::decode_jpeg(bytes, name);
  throw InputError(name, "is neither a PNG nor a JPEG");
}

bool is_display_referred(std::span<const std::byte> bytes) {
  return detail::is_png(bytes) || detail::is_jpeg(bytes);
}

Grid<vec4> decode_linear_image(std::span<const std::byte> bytes, const std::string& name) {
  if (detail::is_png(bytes))
    return detail::is_16_bit_png(bytes)
               ? decoded_from_srgb(detail::decode_png_16(bytes, name), 65535.0)
               : decoded_from_srgb(detail::decode_png_8(bytes, name), 255.0);
  if (detail::is_jpeg(bytes)) return decoded_from_srgb(detail::decode_jpeg(bytes, name), 255.0);
  if (detail::is_exr(bytes)) return detail::decode_exr(bytes, name);
  if (detail::is_hdr(bytes)) return detail::decode_hdr(bytes, name);
  if (detail::is_pfm(bytes)) return detail::decode_pfm(bytes, name);
  throw InputError(name, "is not a picture; expected PNG, JPEG, HDR, EXR or PFM");
}

Grid<vec4> load_image(const std::filesystem::path& path) {
  return decode_linear_image(read_file(path, max_image_bytes), path.string());
}

Grid<u8vec4> display_image(const Grid<vec4>& linear) {
  Grid<u8vec4> texels{linear.width(), linear.height()};
  std::transform(linear.begin(), linear.end(), texels.begin(), [](const vec4& c) {
    return u8vec4(byte_from_unit(srgb_from_linear(double(c.x))),
                  byte_from_unit(srgb_from_linear(double(c.y))),
                  byte_from_unit(srgb_from_linear(double(c.z))), byte_from_unit(double(c.w)));
  });
  return texels;
}

void save_image(const std::filesystem::path& path, const Grid<vec4>& linear,
                const ImageMetadata& metadata) {
  check_can_be_saved(linear.width(), linear.height());
  check_channels(linear, metadata);
  const std::string ending = path.extension().string();
  if (ending == ".png")
    write_file_atomically(path, detail::encode_png(display_image(linear)));
  else if (ending == ".exr")
    write_file_atomically(path, detail::encode_exr(linear, metadata));
  else if (ending == ".hdr")
    write_file_atomically(path, detail::encode_hdr(linear));
  else if (ending == ".pfm")
    write_file_atomically(path, detail::encode_pfm(linear));
  else
    throw std::invalid_argument("save_image: '" + path.string() +
                                "' ends in none of .png, .exr, .hdr, .pfm");
}

void save_png(const std::filesystem::path& path, const Grid<u8vec4>& texels) {
  check_can_be_saved(texels.width(), texels.height());
  write_file_atomically(path, detail::encode_png(texels));
}

}  // namespace parity
