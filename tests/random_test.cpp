#include "geometry/random.h"

#include <gtest/gtest.h>

namespace parity {
namespace {

// The first numbers of pcg32 with seed 42 and stream 54, as O'Neill's demonstration program prints.
TEST(Random, IsPcg32) {
  Random random{42, 54};
  for (const std::uint32_t expected :
       {0xa15c02b7u, 0x7b47f409u, 0xba1d3330u, 0x83d2f293u, 0xbfa4784bu, 0xcbed606eu})
    EXPECT_EQ(random.next(), expected);
}

TEST(Random, StaysBelow) {
  Random random{1};
  std::uint32_t seen = 0;
  for (int i = 0; i < 1000; ++i) {
    const std::uint32_t value = random.below(7);
    ASSERT_LT(value, 7u);
    seen |= 1u << value;
  }
  EXPECT_EQ(seen, 127u);
}

}  // namespace
}  // namespace parity
