#include "tools/progress.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

namespace parity::tools {
namespace {

TEST(Progress, HalfTheWorkIsHalfTheBarAndAsLongAgain) {
  const std::string bar = progress_bar("work", 5, 10, 3.0, 80);
  EXPECT_EQ(std::ranges::count(bar, '#'), 20);
  EXPECT_EQ(std::ranges::count(bar, '.'), 20);
  EXPECT_NE(bar.find("50 % 3 s left"), std::string::npos);
}

TEST(Progress, BarNeverWrapsTheLine) {
  for (std::size_t columns = 0; columns < 100; ++columns)
    EXPECT_LE(progress_bar("a rather long description", 1, 3, 1e6, columns).size(), columns);
}

TEST(Progress, NothingToDoIsDone) {
  EXPECT_NE(progress_bar("work", 0, 0, 0, 80).find("100 %"), std::string::npos);
}

TEST(Progress, WithoutATerminalOneLineForEachTenth) {
  testing::internal::CaptureStderr();
  {
    Progress progress("work", 1000);
    std::this_thread::sleep_for(std::chrono::milliseconds(520));
    for (int i = 0; i < 1000; ++i) progress.advance();
  }
  const std::string printed = testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::ranges::count(printed, '\n'), 10);
  EXPECT_NE(printed.find("work: 100 %\n"), std::string::npos);
}

TEST(Progress, ShortWorkIsSilent) {
  testing::internal::CaptureStderr();
  Progress("work", 2).set(2);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace parity::tools
