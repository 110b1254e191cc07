#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <regex>

#include "geometry/input_error.h"
#include "sim/color_map.h"
#include "tests/temporary_folder.h"
#include "tools/sim_bytes.h"
#include "tools/sim_checkpoint.h"
#include "tools/sim_export.h"

namespace parity {
namespace {

using tools::Checkpoint;

Checkpoint some_checkpoint() {
  return {.physics = R"({"method":"wcsph","spacing":0.1})",
          .backend = "gpu",
          .steps = 123,
          .frames = 2,
          .seconds = 4.5,
          .history = R"([{"time_s":0},{"time_s":1}])",
          .state = std::string("\0\1\2\3", 4)};
}

std::string refusal(const std::string& bytes) {
  try {
    tools::decode_checkpoint(bytes, "checkpoint.bin");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(SimCheckpoint, ComesBackAsItWas) {
  const Checkpoint c = some_checkpoint();
  EXPECT_EQ(tools::decode_checkpoint(tools::encode_checkpoint(c), "x"), c);
}

TEST(SimCheckpoint, EveryCutAndEveryFlippedBitIsRefused) {
  const std::string good = tools::encode_checkpoint(some_checkpoint());
  for (std::size_t length = 0; length < good.size(); ++length)
    EXPECT_NE(refusal(good.substr(0, length)), "") << length;
  for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
    std::string damaged = good;
    damaged[bit / 8] = char(damaged[bit / 8] ^ (1 << (bit % 8)));
    EXPECT_NE(refusal(damaged), "") << bit;
  }
  EXPECT_NE(refusal(good + "x"), "");
}

/// The right checksum over wrong contents.
std::string sealed(const std::string& contents) {
  const std::string good = tools::encode_checkpoint(some_checkpoint());
  tools::ByteWriter tail;
  tail.value(std::uint64_t(contents.size()));
  tail.value(tools::checksum(contents));
  return good.substr(0, 16) + tail.take() + contents;
}

TEST(SimCheckpoint, RightChecksumsDoNotMakeContentsRight) {
  const std::string good = tools::encode_checkpoint(some_checkpoint()).substr(32);
  EXPECT_EQ(refusal(sealed(good)), "");
  EXPECT_NE(refusal(sealed(good + "x")).find("goes on after its end"), std::string::npos);
  EXPECT_NE(refusal(sealed("")).find("cut short"), std::string::npos);
  std::string huge = good;  // a text that claims 2^63 bytes
  huge[7] = char(0x80);
  EXPECT_NE(refusal(sealed(huge)).find("cut short"), std::string::npos);
  Checkpoint wrong = some_checkpoint();
  wrong.frames = 3;
  EXPECT_NE(refusal(tools::encode_checkpoint(wrong)).find("3 frames"), std::string::npos);
  wrong = some_checkpoint();
  wrong.history = std::string(10000, '[');
  EXPECT_NE(refusal(tools::encode_checkpoint(wrong)), "");
  wrong = some_checkpoint();
  wrong.seconds = std::nan("");
  EXPECT_NE(refusal(tools::encode_checkpoint(wrong)).find("duration"), std::string::npos);
}

TEST(SimCheckpoint, ServesItsOwnSceneOnly) {
  const TemporaryFolder folder;
  const Checkpoint c = some_checkpoint();
  const std::filesystem::path path = folder.path() / "checkpoint.bin";
  tools::save_checkpoint(path, c);
  EXPECT_EQ(tools::load_checkpoint(path, c.physics, "gpu"), c);
  EXPECT_THROW(tools::load_checkpoint(path, c.physics, "cpu"), InputError);
  try {
    tools::load_checkpoint(path, R"({"method":"wcsph","spacing":0.2})", "gpu");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("another scene: spacing differs"), std::string::npos);
  }
}

TEST(SimBytes, ListsAreBoundedCountedAndFinite) {
  tools::ByteWriter writer;
  writer.list(std::vector<float>{1, 2, std::nanf("")});
  const std::string bytes = writer.take();
  EXPECT_THROW(tools::ByteReader(bytes).list<float>(2, "values"), std::runtime_error);
  EXPECT_THROW(tools::ByteReader(bytes).list<float>(3, "values"), std::runtime_error);
  EXPECT_THROW(tools::ByteReader(bytes.substr(0, 16)).list<float>(3, "values"), std::runtime_error);
}

tools::SimContent some_content() {
  tools::SimContent c;
  c.time = 1.5;
  c.positions = {{0.25f, 0.5f, 0.75f}, {1, 2, 3}};
  c.velocities = {{-1, 0, 1}, {4, 5, 6}};
  c.pressures = {7, 8};
  c.cells = {2, 1, 1};
  c.spacing = 0.5f;
  c.flow = {{1, 2, 3}, {4, 5, 6}};
  c.smoke = {0.25f, 0.75f};
  return c;
}

TEST(SimExport, PlyHoldsTheParticles) {
  const std::string text = tools::encode_particles_ply(some_content());
  const std::size_t end = text.find("end_header\n") + 11;
  EXPECT_TRUE(text.starts_with("ply\nformat binary_little_endian 1.0\n"));
  EXPECT_NE(text.find("element vertex 2\n"), std::string::npos);
  ASSERT_EQ(text.size() - end, 2 * 7 * sizeof(float));
  float values[14];
  std::memcpy(values, text.data() + end, sizeof values);
  const float want[14] = {0.25f, 0.5f, 0.75f, -1, 0, 1, 7, 1, 2, 3, 4, 5, 6, 8};
  EXPECT_TRUE(std::equal(values, values + 14, want));
}

/// What a reader of VTK XML files finds: the elements' attributes and, at their offsets, the bytes.
template <typename T>
std::vector<T> vtk_array(const std::string& file, const std::string& name) {
  std::smatch match;
  const std::regex element("<DataArray type=\"(\\w+)\" Name=\"" + name +
                           "\" NumberOfComponents=\"\\d\" format=\"appended\" offset=\"(\\d+)\"/>");
  EXPECT_TRUE(std::regex_search(file, match, element)) << name;
  const std::size_t begin = file.find("encoding=\"raw\">\n_") + 17 + std::stoul(match[2]);
  std::uint64_t size = 0;
  std::memcpy(&size, file.data() + begin, sizeof size);
  EXPECT_LE(begin + 8 + size, file.size());
  std::vector<T> values(size / sizeof(T));
  std::memcpy(values.data(), file.data() + begin + 8, size);
  return values;
}

TEST(SimExport, VtpHoldsTheParticles) {
  const tools::SimContent content = some_content();
  const std::string file = tools::encode_vtp(content);
  EXPECT_NE(file.find("header_type=\"UInt64\""), std::string::npos);
  EXPECT_NE(file.find("NumberOfPoints=\"2\" NumberOfVerts=\"2\""), std::string::npos);
  EXPECT_EQ(vtk_array<vec3>(file, "Points"), content.positions);
  EXPECT_EQ(vtk_array<vec3>(file, "velocity"), content.velocities);
  EXPECT_EQ(vtk_array<float>(file, "pressure"), content.pressures);
  EXPECT_EQ(vtk_array<std::int64_t>(file, "connectivity"), (std::vector<std::int64_t>{0, 1}));
  EXPECT_EQ(vtk_array<std::int64_t>(file, "offsets"), (std::vector<std::int64_t>{1, 2}));
}

TEST(SimExport, VtiHoldsTheCells) {
  const tools::SimContent content = some_content();
  const std::string file = tools::encode_vti(content);
  EXPECT_NE(file.find("WholeExtent=\"0 2 0 1 0 1\" Origin=\"0 0 0\" Spacing=\"0.5 0.5 0.5\""),
            std::string::npos);
  EXPECT_NE(file.find("Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">1.5<"),
            std::string::npos);
  EXPECT_EQ(vtk_array<vec3>(file, "velocity"), content.flow);
  EXPECT_EQ(vtk_array<float>(file, "smoke"), content.smoke);
  EXPECT_EQ(file.find("temperature"), std::string::npos);
}

TEST(ColorMap, OklabKnowsWhiteAndGoesBothWays) {
  const dvec3 white = oklab_from_linear(dvec3(1));  // lightness 1, no hue; published to 8 digits
  EXPECT_NEAR(white.x, 1, 1e-6);
  EXPECT_NEAR(white.y, 0, 1e-6);
  EXPECT_NEAR(white.z, 0, 1e-6);
  const dvec3 red = oklab_from_linear(dvec3(1, 0, 0));  // Ottosson: 0.628, 0.225, 0.126
  EXPECT_NEAR(red.x, 0.628, 5e-4);
  EXPECT_NEAR(red.y, 0.225, 5e-4);
  EXPECT_NEAR(red.z, 0.126, 5e-4);
  const dvec3 color{0.2, 0.5, 0.7};
  EXPECT_LT(glm::length(linear_from_oklab(oklab_from_linear(color)) - color), 1e-6);
}

TEST(ColorMap, LightnessIsLinear) {
  for (const ColorMapKind kind :
       {ColorMapKind::sequential, ColorMapKind::water, ColorMapKind::diverging}) {
    const std::vector<vec3> map = color_map(kind, 65);
    std::vector<double> lightness;
    for (const vec3& c : map) {
      EXPECT_GE(std::min({c.x, c.y, c.z}), 0);
      EXPECT_LE(std::max({c.x, c.y, c.z}), 1);
      lightness.push_back(oklab_from_linear(dvec3(c)).x);
    }
    const int half = kind == ColorMapKind::diverging ? 32 : 64;
    const double step = (lightness[std::size_t(half)] - lightness[0]) / half;
    EXPECT_GT(step, 0.005);
    for (int i = 0; i <= half; ++i)  // the matrices have 10 digits, colours 24 bits
      EXPECT_NEAR(lightness[std::size_t(i)], lightness[0] + step * i, 1e-6);
    EXPECT_TRUE(half == 64 || std::abs(lightness[64] - lightness[0]) < 1e-6);
  }
}

}  // namespace
}  // namespace parity
