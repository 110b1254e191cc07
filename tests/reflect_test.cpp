#include <gtest/gtest.h>

#include "gpu/core/error.h"
#include "shaders.h"

namespace parity {
namespace {

using gpu::reflect;
using gpu::ShaderReflection;

TEST(Reflect, ReadsPushConstantsAndWorkgroup) {
  const ShaderReflection add = reflect(gpu::shaders::core_test_add_comp);
  EXPECT_EQ(add.push_constant_bytes, 24u);  // two addresses, a uint, a float
  EXPECT_EQ(add.local_size[0], 64u);
  EXPECT_EQ(add.local_size_constant[0], 0);
  EXPECT_EQ(add.local_size[1], 1u);
  EXPECT_EQ(add.local_size_constant[1], -1);
  EXPECT_EQ(add.specialization_ids, std::vector<std::uint32_t>{0});
  EXPECT_TRUE(add.descriptors.empty());
}

TEST(Reflect, RoundsPushConstantsUpAsCppDoes) {
  // An address and three uints: 20 bytes of data, 24 with the address's alignment of 8.
  EXPECT_EQ(reflect(gpu::shaders::core_test_samples_comp).push_constant_bytes, 24u);
}

TEST(Reflect, ReadsImages) {
  using Kind = ShaderReflection::Descriptor::Kind;
  const ShaderReflection invert = reflect(gpu::shaders::core_test_invert_comp);
  ASSERT_EQ(invert.descriptors.size(), 2u);
  for (const ShaderReflection::Descriptor& each : invert.descriptors) {
    EXPECT_EQ(each.set, 0);
    EXPECT_EQ(each.kind, each.binding == 0 ? Kind::sampled_image : Kind::storage_image);
    EXPECT_TRUE(each.binding == 0 || each.binding == 2);
  }
  EXPECT_EQ(invert.local_size[0], 8u);
  EXPECT_EQ(invert.local_size[1], 8u);
}

TEST(Reflect, AFragmentShaderMayHaveNeither) {
  const ShaderReflection fragment = reflect(gpu::shaders::core_test_triangle_frag);
  EXPECT_EQ(fragment.push_constant_bytes, 0u);
  EXPECT_TRUE(fragment.descriptors.empty());
}

/// Whether the words are read or refused; anything else ends the test.
bool accepts(std::span<const std::uint32_t> words) {
  try {
    reflect({"damaged", words});
    return true;
  } catch (const gpu::Error& error) {
    EXPECT_EQ(error.kind(), gpu::ErrorKind::invalid_shader);
    return false;
  }
}

TEST(Reflect, RefusesWhatIsNoModule) {
  EXPECT_FALSE(accepts({}));
  const std::vector<std::uint32_t> header{0x07230203, 0x00010600, 0, 100, 0};
  EXPECT_FALSE(accepts(std::span(header).first(4)));
  EXPECT_FALSE(accepts(header));  // no entry point
  std::vector<std::uint32_t> nothing = header;
  nothing.push_back(0);  // an instruction of no words
  EXPECT_FALSE(accepts(nothing));
}

TEST(Reflect, RefusesInstructionsThatLackAWord) {
  // OpTypePointer has three operands; with two, the third would be the next instruction.
  const std::uint32_t entry_point = (2u << 16) | 15;
  const std::uint32_t type_pointer = (3u << 16) | 32;
  EXPECT_TRUE(accepts(std::vector<std::uint32_t>{0x07230203, 0x00010600, 0, 9, 0, entry_point, 5}));
  EXPECT_FALSE(accepts(std::vector<std::uint32_t>{0x07230203, 0x00010600, 0, 9, 0, type_pointer, 1,
                                                  2, entry_point, 5}));
}

TEST(Reflect, SurvivesTruncation) {
  const std::span<const std::uint32_t> words = gpu::shaders::core_test_invert_comp.words;
  for (std::size_t length = 0; length < words.size(); ++length) {
    // A copy of its own, so that a sanitizer sees reads past the end.
    const std::vector<std::uint32_t> part(words.begin(),
                                          words.begin() + static_cast<std::ptrdiff_t>(length));
    accepts(part);
  }
}

TEST(Reflect, SurvivesDamagedWords) {
  std::uint32_t state = 1;
  const auto random = [&state] { return state = state * 1664525u + 1013904223u; };
  for (const gpu::ShaderCode& code :
       {gpu::shaders::core_test_invert_comp, gpu::shaders::core_test_add_comp}) {
    for (int round = 0; round < 20'000; ++round) {
      std::vector<std::uint32_t> words(code.words.begin(), code.words.end());
      for (int damage = 0; damage < 1 + round % 4; ++damage) {
        std::uint32_t& word = words[5 + (random() >> 8) % (words.size() - 5)];
        word = round % 2 == 0 ? random() : (word & ~0xFFu) | (random() >> 24);
      }
      accepts(words);
    }
  }
}

}  // namespace
}  // namespace parity
