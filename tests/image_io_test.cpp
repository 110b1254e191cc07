#include "geometry/image_io.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <bit>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <limits>
#include <numbers>

#include "geometry/atomic_file.h"
#include "geometry/color.h"
#include "geometry/input_error.h"
#include "geometry/output_error.h"
#include "tests/shared_data.h"

namespace parity {
namespace {

constexpr std::size_t megabyte = 1u << 20;

/// A folder that goes with its contents.
class TemporaryFolder {
 public:
  TemporaryFolder()
      : path_(std::filesystem::temp_directory_path() /
              ("parity_image_io_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  std::size_t file_count() const {
    return std::size_t(std::distance(std::filesystem::directory_iterator(path_), {}));
  }

 private:
  std::filesystem::path path_;
};

std::span<const std::byte> as_bytes(const std::string& text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

/// Smooth colours with a wide range, alpha included.
Grid<vec4> sample_picture(int width, int height) {
  Grid<vec4> image{width, height};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image(x, y) = {0.25f + float(x) / 3.0f, float(y * y) / 7.0f, std::exp2(float(x - y)),
                     float((x + y) % 5) / 4.0f};
  return image;
}

Grid<vec4> saved_and_loaded(const Grid<vec4>& image, const std::string& ending) {
  const TemporaryFolder folder;
  save_image(folder / ("picture" + ending), image, {});
  EXPECT_EQ(folder.file_count(), 1u);
  return load_image(folder / ("picture" + ending));
}

TEST(Color, SrgbHasItsPublishedValuesAndInverse) {
  EXPECT_EQ(srgb_from_linear(0.0), 0.0);
  EXPECT_NEAR(srgb_from_linear(1.0), 1.0, 1e-15);
  EXPECT_NEAR(srgb_from_linear(0.5), 0.735356983052449, 1e-14);
  EXPECT_NEAR(linear_from_srgb(0.5), 0.214041140482232, 1e-14);
  EXPECT_NEAR(srgb_from_linear(0.001), 0.01292, 1e-16);
  // The two published thresholds meet within 1e-7 only; beside them the inverse holds to rounding.
  for (double v : {0.0, 0.001, 0.003, 0.0032, 0.01, 0.2, 0.9, 1.0})
    EXPECT_NEAR(linear_from_srgb(srgb_from_linear(v)), v, 1e-15);
}

TEST(ImageIo, PngRoundsToNearestAndClamps) {
  Grid<vec4> image{4, 1};
  image(0, 0) = vec4(std::numeric_limits<float>::quiet_NaN(), -1.0f, 2.0f, 1.0f);
  image(1, 0) = vec4(0.5f, 0.0f, 1.0f, 0.5f);
  image(2, 0) = vec4(std::numeric_limits<float>::infinity(), -0.0f, 0.214041140f, 0.0f);
  const Grid<u8vec4> texels = display_image(image);
  EXPECT_EQ(texels(0, 0), u8vec4(0, 0, 255, 255));
  EXPECT_EQ(texels(1, 0), u8vec4(188, 0, 255, 128));  // 0.73536 255 = 187.5+, 0.5 255 = 127.5
  EXPECT_EQ(texels(2, 0), u8vec4(255, 0, 128, 0));
}

TEST(ImageIo, EveryByteSurvivesAPng) {
  Grid<u8vec4> texels{256, 3};
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 256; ++x) texels(x, y) = u8vec4(x, 255 - x, (x * 7 + y) & 255, x ^ y);
  const TemporaryFolder folder;
  save_png(folder / "a.png", texels);
  EXPECT_EQ(decode_image(read_file(folder / "a.png", megabyte), "a.png"), texels);
  save_image(folder / "b.png", load_image(folder / "a.png"), {});
  EXPECT_EQ(decode_image(read_file(folder / "b.png", megabyte), "b.png"), texels);
}

void append_big_endian(std::string& bytes, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes += char(value >> shift);
}

std::uint32_t crc32(const std::string& bytes) {
  std::uint32_t crc = 0xffffffffu;
  for (unsigned char byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ (crc & 1 ? 0xedb88320u : 0);
  }
  return ~crc;
}

std::string png_chunk(const std::string& type, const std::string& data) {
  std::string chunk;
  append_big_endian(chunk, std::uint32_t(data.size()));
  chunk += type + data;
  append_big_endian(chunk, crc32(type + data));
  return chunk;
}

/// A zlib stream that holds the bytes as they are.
std::string stored(const std::string& bytes) {
  std::uint32_t a = 1, b = 0;
  for (unsigned char byte : bytes) {
    a = (a + byte) % 65521;
    b = (b + a) % 65521;
  }
  const auto size = std::uint16_t(bytes.size());
  std::string stream = "\x78\x01\x01";
  for (std::uint32_t half : {std::uint32_t(size), std::uint32_t(std::uint16_t(~size))})
    stream += {char(half), char(half >> 8)};
  stream += bytes;
  append_big_endian(stream, b << 16 | a);
  return stream;
}

/// A PNG of one row of `width` texels.
std::string png_row(int width, int bit_depth, int color_type, const std::string& row,
                    const std::string& chunks_before) {
  std::string header;
  append_big_endian(header, std::uint32_t(width));
  append_big_endian(header, 1);
  header += {char(bit_depth), char(color_type), 0, 0, 0};
  return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) + chunks_before +
         png_chunk("IDAT", stored(std::string(1, '\0') + row)) + png_chunk("IEND", "");
}

TEST(ImageIo, PngKeepsSixteenBits) {
  const std::string png =
      png_row(2, 16, 2, std::string("\x12\x34\xff\xff\0\0\x80\0\0\1\0\xff", 12), "");
  const Grid<vec4> linear = decode_linear_image(as_bytes(png), "a.png");
  EXPECT_EQ(linear(0, 0), vec4(float(linear_from_srgb(0x1234 / 65535.0)), 1.0f, 0.0f, 1.0f));
  EXPECT_EQ(linear(1, 0).x, float(linear_from_srgb(0x8000 / 65535.0)));
  EXPECT_EQ(linear(1, 0).y, float(linear_from_srgb(1 / 65535.0)));
  // 0x1234 = 4660: 4660 / 257 = 18.13; 0x8000: 127.502; 0xff: 0.992
  const Grid<u8vec4> texels = decode_image(as_bytes(png), "a.png");
  EXPECT_EQ(texels(0, 0), u8vec4(18, 255, 0, 255));
  EXPECT_EQ(texels(1, 0), u8vec4(128, 0, 1, 255));
}

TEST(ImageIo, PngOfEveryColorTypeBecomesRgba) {
  const std::string palette =
      png_chunk("PLTE", std::string("\1\2\3\4\5\6", 6)) + png_chunk("tRNS", std::string("\x80", 1));
  const Grid<u8vec4> indexed =
      decode_image(as_bytes(png_row(2, 2, 3, std::string("\x10", 1), palette)), "a.png");
  EXPECT_EQ(indexed(0, 0), u8vec4(1, 2, 3, 0x80));
  EXPECT_EQ(indexed(1, 0), u8vec4(4, 5, 6, 255));
  const Grid<u8vec4> grey =
      decode_image(as_bytes(png_row(3, 1, 0, std::string("\x40", 1), "")), "a.png");
  EXPECT_EQ(grey(0, 0), u8vec4(0, 0, 0, 255));
  EXPECT_EQ(grey(1, 0), u8vec4(255));
  const Grid<u8vec4> with_alpha = decode_image(as_bytes(png_row(1, 8, 4, "\x30\x60", "")), "a.png");
  EXPECT_EQ(with_alpha(0, 0), u8vec4(0x30, 0x30, 0x30, 0x60));
}

TEST(ImageIo, RefusesPicturesThatTheirFileCannotHold) {
  std::string header;
  append_big_endian(header, 16384);
  append_big_endian(header, 16384);
  header += {8, 6, 0, 0, 0};
  const std::string png = "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) +
                          png_chunk("IDAT", stored("")) + png_chunk("IEND", "");
  const auto refusal_of = [](const std::string& bytes) -> std::string {
    try {
      decode_linear_image(as_bytes(bytes), "a");
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_NE(refusal_of(png).find("can hold"), std::string::npos);
  EXPECT_NE(refusal_of("PF\n16384 16384\n-1\n").find("can hold"), std::string::npos);
  EXPECT_NE(refusal_of("Pf\n16385 1\n-1\n" + std::string(65540, 'a')).find("16385x1"),
            std::string::npos);
}

TEST(ImageIo, PfmKeepsEveryBitOfColor) {
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(131, 7)}) {
    Grid<vec4> image = sample_picture(width, height);
    for (vec4& texel : image) texel.w = 1.0f;
    EXPECT_EQ(saved_and_loaded(image, ".pfm"), image);
  }
}

TEST(ImageIo, PfmIsReadInEitherByteOrderAndInGrey) {
  std::string big = "PF\n1 2\n1.0\n", little = "Pf\n2 1\n-1.0\n";
  for (float value : {1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f})
    for (int i = 3; i >= 0; --i) big += char(std::bit_cast<std::uint32_t>(value) >> (8 * i));
  for (float value : {7.0f, 8.0f})
    for (int i = 0; i < 4; ++i) little += char(std::bit_cast<std::uint32_t>(value) >> (8 * i));
  const Grid<vec4> color = decode_linear_image(as_bytes(big), "big");
  EXPECT_EQ(color(0, 0), vec4(4, 5, 6, 1));  // rows from the bottom
  EXPECT_EQ(color(0, 1), vec4(1, 2, 3, 1));
  const Grid<vec4> grey = decode_linear_image(as_bytes(little), "little");
  EXPECT_EQ(grey(0, 0), vec4(7, 7, 7, 1));
  EXPECT_EQ(grey(1, 0), vec4(8, 8, 8, 1));
}

TEST(ImageIo, ExrKeepsHalfPrecision) {
  const Grid<vec4> image = sample_picture(37, 19);
  const Grid<vec4> back = saved_and_loaded(image, ".exr");
  ASSERT_EQ(back.width(), 37);
  ASSERT_EQ(back.height(), 19);
  // A half has 11 significant bits (error 2^-11 relative) down to 2^-14, and steps of 2^-24 below.
  for (std::size_t i = 0; i < image.size(); ++i)
    for (int c = 0; c < 4; ++c) {
      const double want = image.values()[i][c];
      const double clamped = std::min(want, 65504.0);
      EXPECT_NEAR(back.values()[i][c], clamped, std::max(clamped * std::exp2(-11), std::exp2(-25)));
    }
}

TEST(ImageIo, ExrCarriesTextAndLayers) {
  const TemporaryFolder folder;
  ImageMetadata metadata;
  metadata.attributes = {{"seed", "7"}, {"device", "a device"}};
  metadata.channels = {{"Z", Grid<float>(3, 2, 1.2345678f)}};
  save_image(folder / "a.exr", Grid<vec4>(3, 2, vec4(0.5f)), metadata);
  const std::vector<std::byte> bytes = read_file(folder / "a.exr", megabyte);
  const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  EXPECT_NE(text.find("a device"), std::string::npos);
  EXPECT_NE(text.find(std::string("Z\0\2", 3)), std::string::npos);  // channel Z of type 2, float
  EXPECT_EQ(load_image(folder / "a.exr"), Grid<vec4>(3, 2, vec4(0.5f)));
}

TEST(ImageIo, ExrPlacesItsDataInItsDisplayWindow) {
  const TemporaryFolder folder;
  const Grid<vec4> data = sample_picture(5, 4);
  save_image(folder / "a.exr", data, {});
  std::vector<std::byte> bytes = read_file(folder / "a.exr", megabyte);
  // The display window (two corners of two whole numbers) now goes from (2, -1) to (8, 1).
  const std::string key("displayWindow\0box2i\0\x10\0\0\0", 24);
  const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  ASSERT_NE(text.find(key), std::string::npos);
  const std::int32_t corners[] = {2, -1, 8, 1};
  std::memcpy(bytes.data() + text.find(key) + key.size(), corners, sizeof corners);
  const Grid<vec4> whole = decode_linear_image(read_file(folder / "a.exr", megabyte), "a.exr");
  const Grid<vec4> placed = decode_linear_image(bytes, "b.exr");
  ASSERT_EQ(placed.width(), 7);
  ASSERT_EQ(placed.height(), 3);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 7; ++x)
      EXPECT_EQ(placed(x, y), x < 3 && y > 0 ? whole(x + 2, y - 1) : vec4(0.0f)) << x << " " << y;
}

TEST(ImageIo, HdrKeepsEightBitsOfTheLargestComponent) {
  for (int width : {1, 7, 8, 131, 400}) {
    const Grid<vec4> image = sample_picture(width, 5);
    const Grid<vec4> back = saved_and_loaded(image, ".hdr");
    for (int y = 0; y < 5; ++y)
      for (int x = 0; x < width; ++x) {
        const vec4 want = image(x, y), got = back(x, y);
        const double largest = std::max({want.x, want.y, want.z});
        if (largest > 1.6e38) continue;  // beyond what the format can say
        // Steps of 2^(e-8) with 2^(e-1) <= largest: half a step is at most largest / 256; twice
        // that where rounding up made the exponent grow.
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(got[c], want[c], largest / 255.0);
        ASSERT_EQ(got.w, 1.0f);
      }
  }
}

TEST(ImageIo, HdrReadsExposureOrientationAndOldRuns) {
  const auto texel = [](int r, int g, int b, int e) {
    return std::string{char(r), char(g), char(b), char(e)};
  };
  const std::string head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2.0\n\n";
  const Grid<vec4> run = decode_linear_image(
      as_bytes(head + "-Y 1 +X 4\n" + texel(128, 64, 0, 129) + texel(1, 1, 1, 3)), "run");
  EXPECT_EQ(run, Grid<vec4>(4, 1, vec4(0.5f, 0.25f, 0.0f, 1.0f)));
  const Grid<vec4> long_run =
      decode_linear_image(as_bytes(head + "-Y 1 +X 600\n" + texel(128, 64, 0, 129) +
                                   texel(1, 1, 1, 600 - 1 - 512) + texel(1, 1, 1, 2)),
                          "long run");
  EXPECT_EQ(long_run, Grid<vec4>(600, 1, vec4(0.5f, 0.25f, 0.0f, 1.0f)));
  const Grid<vec4> turned = decode_linear_image(
      as_bytes(head + "+Y 2 -X 1\n" + texel(128, 0, 0, 129) + texel(0, 128, 0, 129)), "turned");
  EXPECT_EQ(turned(0, 1), vec4(0.5f, 0.0f, 0.0f, 1.0f));
  EXPECT_EQ(turned(0, 0), vec4(0.0f, 0.5f, 0.0f, 1.0f));
}

TEST(ImageIo, RefusesWhatCannotBeSaved) {
  const TemporaryFolder folder;
  EXPECT_THROW(save_image(folder / "a.tga", Grid<vec4>(1, 1), {}), std::invalid_argument);
  EXPECT_THROW(save_image(folder / "a.png", Grid<vec4>(), {}), std::invalid_argument);
  EXPECT_THROW(save_image(folder / "none/a.png", Grid<vec4>(1, 1), {}), OutputError);
  EXPECT_EQ(folder.file_count(), 0u);
}

TEST(AtomicFile, AFailureLeavesNothingBehind) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "taken");
  EXPECT_THROW(write_file_atomically(folder / "taken", "text"), OutputError);
  EXPECT_THROW(write_file_atomically("/dev/full", "text"), OutputError);
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
  write_file_atomically(folder / "a", "one");
  write_file_atomically(folder / "a", "two");
  EXPECT_EQ(read_file(folder / "a", 3).size(), 3u);
  EXPECT_EQ(folder.file_count(), 2u);
}

TEST(AtomicFile, AWriteThatBreaksOffLeavesWhatWasThere) {
  const TemporaryFolder folder;
  write_file_atomically(folder / "a", "before");
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const rlimit tight{16, before.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);  // a write past the limit fails instead
  ::setrlimit(RLIMIT_FSIZE, &tight);
  EXPECT_THROW(write_file_atomically(folder / "a", std::string(1000, 'x')), OutputError);
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(read_file(folder / "a", 100).size(), 6u);
  EXPECT_EQ(folder.file_count(), 1u);
}

TEST(AtomicFile, ReadsNoFolderNoDeviceAndNotTooMuch) {
  const TemporaryFolder folder;
  write_file_atomically(folder / "a", "four");
  EXPECT_THROW(read_file(folder / "a", 3), InputError);
  EXPECT_THROW(read_file(folder / "", 3), InputError);
  EXPECT_THROW(read_file(folder / "missing", 3), InputError);
  EXPECT_THROW(read_file("/dev/zero", 3), InputError);
}

}  // namespace
}  // namespace parity
