#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

// libjpeg's header needs <cstdio> before it.
// clang-format off
#include <jpeglib.h>
// clang-format on

#include "geometry/image_io.h"
#include "geometry/input_error.h"

namespace parity {
namespace {

/// A slow ramp: 8x8 blocks hold it almost exactly.
int ramp(int x, int y, int c) { return 60 + 2 * x + y + 20 * c; }

std::string ramp_jpeg(int width, int height, int components, bool is_progressive) {
  jpeg_compress_struct codec = {};
  jpeg_error_mgr errors = {};
  codec.err = jpeg_std_error(&errors);
  jpeg_create_compress(&codec);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&codec, &bytes, &size);
  codec.image_width = JDIMENSION(width);
  codec.image_height = JDIMENSION(height);
  codec.input_components = components;
  codec.in_color_space = components == 1 ? JCS_GRAYSCALE : components == 3 ? JCS_RGB : JCS_CMYK;
  jpeg_set_defaults(&codec);
  jpeg_set_quality(&codec, 100, TRUE);
  for (int c = 0; c < codec.num_components; ++c)
    codec.comp_info[c].h_samp_factor = codec.comp_info[c].v_samp_factor = 1;
  if (is_progressive) jpeg_simple_progression(&codec);
  jpeg_start_compress(&codec, TRUE);
  std::string row(std::size_t(width * components), '\0');
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < components; ++c)
        row[std::size_t(x * components + c)] = char(ramp(x, y, c));
    JSAMPROW pointer = reinterpret_cast<JSAMPROW>(row.data());
    jpeg_write_scanlines(&codec, &pointer, 1);
  }
  jpeg_finish_compress(&codec);
  jpeg_destroy_compress(&codec);
  const std::string jpeg(reinterpret_cast<const char*>(bytes), size);
  std::free(bytes);
  return jpeg;
}

Grid<u8vec4> decode(const std::string& bytes) {
  return decode_image(std::as_bytes(std::span(bytes.data(), bytes.size())), "a.jpg");
}

// At quality 100 coefficients are rounded to whole numbers: a pixel is off by less than 2 in YCbCr,
// and a conversion to RGB and back rounds twice more.
TEST(Jpeg, ReadsGreyAndColorInOneScanAndInMany) {
  for (bool is_progressive : {false, true})
    for (int components : {1, 3}) {
      const Grid<u8vec4> image = decode(ramp_jpeg(37, 21, components, is_progressive));
      ASSERT_EQ(image.width(), 37);
      ASSERT_EQ(image.height(), 21);
      for (int y = 0; y < 21; ++y)
        for (int x = 0; x < 37; ++x) {
          for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(int(image(x, y)[c]), ramp(x, y, components == 1 ? 0 : c), 4);
          EXPECT_EQ(int(image(x, y).w), 255);
        }
    }
}

TEST(Jpeg, RefusesWhatIsCutShortOrInInks) {
  const std::string whole = ramp_jpeg(37, 21, 3, false);
  for (std::size_t length = 0; length + 2 < whole.size(); length += 7)
    EXPECT_THROW(decode(whole.substr(0, length)), InputError) << length;
  EXPECT_THROW(decode(ramp_jpeg(8, 8, 4, false)), InputError);
}

}  // namespace
}  // namespace parity
