#include <png.h>
#include <stb/stb_image_write.h>

#include <cstring>
#include <stdexcept>

#include "geometry/image_formats.h"
#include "geometry/input_error.h"

namespace parity::detail {
namespace {

/// libpng reports an error by a long jump, so what happens between setjmp and the jump owns
/// nothing: all state is here.
struct PngReader {
  Bytes bytes;
  std::size_t offset = 0;
  png_structp png = nullptr;
  png_infop info = nullptr;
  char error[160] = {};

  PngReader() = default;
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;
  ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
};

[[noreturn]] void on_error(png_structp png, png_const_charp message) {
  auto* reader = static_cast<PngReader*>(png_get_error_ptr(png));
  std::strncpy(reader->error, message, sizeof reader->error - 1);
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

void on_read(png_structp png, png_bytep out, std::size_t count) {
  auto* reader = static_cast<PngReader*>(png_get_io_ptr(png));
  if (count > reader->bytes.size() - reader->offset) png_error(png, "the file ends too early");
  std::memcpy(out, reader->bytes.data() + reader->offset, count);
  reader->offset += count;
}

bool read_header(PngReader& reader) {
  if (setjmp(png_jmpbuf(reader.png))) return false;
  png_set_user_limits(reader.png, max_image_side, max_image_side);
  png_set_chunk_malloc_max(reader.png, 8u << 20);
  png_set_read_fn(reader.png, &reader, on_read);
  png_read_info(reader.png, reader.info);
  return true;
}

bool convert_to_rgba(PngReader& reader, bool keep_16_bits) {
  if (setjmp(png_jmpbuf(reader.png))) return false;
  png_set_expand(reader.png);
  png_set_gray_to_rgb(reader.png);
  if (keep_16_bits)
    png_set_swap(reader.png);
  else
    png_set_scale_16(reader.png);
  png_set_add_alpha(reader.png, keep_16_bits ? 0xffff : 0xff, PNG_FILLER_AFTER);
  png_set_interlace_handling(reader.png);
  png_read_update_info(reader.png, reader.info);
  return true;
}

bool read_rows(PngReader& reader, png_bytepp rows) {
  if (setjmp(png_jmpbuf(reader.png))) return false;
  png_read_image(reader.png, rows);
  png_read_end(reader.png, nullptr);
  return true;
}

template <typename Texel>
Grid<Texel> decode(Bytes bytes, const std::string& name) {
  PngReader reader;
  reader.bytes = bytes;
  reader.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reader, on_error, on_warning);
  if (reader.png != nullptr) reader.info = png_create_info_struct(reader.png);
  if (reader.info == nullptr) throw std::bad_alloc();
  const auto refuse = [&] { return InputError(name, std::string("bad PNG: ") + reader.error); };

  if (!read_header(reader)) throw refuse();
  const png_uint_32 width = png_get_image_width(reader.png, reader.info);
  const png_uint_32 height = png_get_image_height(reader.png, reader.info);
  check_claimed_size(name, width, height, bytes.size());
  if (!convert_to_rgba(reader, sizeof(Texel) == 8)) throw refuse();
  if (png_get_rowbytes(reader.png, reader.info) != width * sizeof(Texel))
    throw InputError(name, "bad PNG: its rows are not RGBA after conversion");

  Grid<Texel> texels{int(width), int(height)};
  std::vector<png_bytep> rows(height);
  for (std::size_t y = 0; y < height; ++y)
    rows[y] = reinterpret_cast<png_bytep>(texels.data() + y * width);
  if (!read_rows(reader, rows.data())) throw refuse();
  return texels;
}

constexpr unsigned char signature[] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
constexpr std::size_t bit_depth_offset = 24;  // signature 8, chunk head 8, width 4, height 4

}  // namespace

bool is_png(Bytes bytes) {
  return bytes.size() >= sizeof signature &&
         std::memcmp(bytes.data(), signature, sizeof signature) == 0;
}

bool is_16_bit_png(Bytes bytes) {
  return bytes.size() > bit_depth_offset && bytes[bit_depth_offset] == std::byte{16};
}

Grid<u8vec4> decode_png_8(Bytes bytes, const std::string& name) {
  return decode<u8vec4>(bytes, name);
}

Grid<u16vec4> decode_png_16(Bytes bytes, const std::string& name) {
  return decode<u16vec4>(bytes, name);
}

std::vector<std::byte> encode_png(const Grid<u8vec4>& texels) {
  std::vector<std::byte> bytes;
  const auto append = [](void* context, void* data, int size) {
    auto& out = *static_cast<std::vector<std::byte>*>(context);
    const auto* begin = static_cast<const std::byte*>(data);
    out.insert(out.end(), begin, begin + size);
  };
  if (!stbi_write_png_to_func(append, &bytes, texels.width(), texels.height(), 4, texels.data(), 0))
    throw std::runtime_error("PNG: out of memory");
  return bytes;
}

}  // namespace parity::detail
