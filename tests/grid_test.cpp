#include "geometry/grid.h"

#include <gtest/gtest.h>

namespace parity {
namespace {

TEST(Grid, IsRowMajorFromTheTop) {
  Grid<int> grid{3, 2};
  grid(2, 1) = 7;
  EXPECT_EQ(grid.values()[5], 7);
}

TEST(Grid, RefusesANegativeSide) { EXPECT_THROW((Grid<int>{-1, 2}), std::invalid_argument); }

}  // namespace
}  // namespace parity
