#include "tests/gpu_context.h"

#include <gtest/gtest.h>

#include <memory>

namespace parity {
namespace {

std::unique_ptr<gpu::Context>& slot() {
  static std::unique_ptr<gpu::Context> context;
  return context;
}

/// Fails tests that made the validation layer speak; destroys the context at the end.
class Watch : public testing::EmptyTestEventListener {
  void OnTestEnd(const testing::TestInfo&) override {
    if (slot() == nullptr) return;
    for (const std::string& message : slot()->take_validation_messages())
      ADD_FAILURE() << "validation: " << message;
  }
  void OnTestProgramEnd(const testing::UnitTest&) override { slot().reset(); }
};

// GoogleTest owns its listeners. In front of the printer's, so that a failure is printed.
[[maybe_unused]] const bool watching = [] {
  testing::TestEventListeners& listeners = testing::UnitTest::GetInstance()->listeners();
  listeners.Append(new Watch);
  return true;
}();

TEST(GpuContext, IsValidatedAndGuarded) {
  EXPECT_TRUE(test_context().options().validation);
  EXPECT_EQ(test_context().options().guard, gpu::Guard::zones);
}

}  // namespace

gpu::Context& test_context() {
  if (slot() == nullptr)
    slot() = std::make_unique<gpu::Context>(
        gpu::ContextOptions{.device = "", .validation = true, .guard = gpu::Guard::zones});
  return *slot();
}

}  // namespace parity
