#include "tests/gpu_context.h"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>

// The validation layer 1.3.239 leaks some of its own. So that the leak sanitizer can tell, the
// layer stays loaded (see below).
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libVkLayer_khronos_validation\n";
}

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
  dlopen("libVkLayer_khronos_validation.so", RTLD_LAZY | RTLD_NODELETE);
  return true;
}();

gpu::ContextOptions options_of_environment() {
  const char* guard = std::getenv("PARITY_TEST_GUARD");
  const bool fences = guard != nullptr && std::string(guard) == "fences";
  if (guard != nullptr && !fences && std::string(guard) != "zones")
    throw std::invalid_argument("PARITY_TEST_GUARD is " + std::string(guard) +
                                ", must be zones or fences");
  return {.device = "",
          .validation = true,
          .gpu_assisted = std::getenv("PARITY_TEST_ASSISTED") != nullptr,
          .guard = fences ? gpu::Guard::fences : gpu::Guard::zones};
}

TEST(GpuContext, IsValidatedAndGuarded) {
  EXPECT_TRUE(test_context().options().validation);
  EXPECT_NE(test_context().options().guard, gpu::Guard::none);
}

}  // namespace

gpu::Context& test_context() {
  if (slot() == nullptr) slot() = std::make_unique<gpu::Context>(options_of_environment());
  return *slot();
}

}  // namespace parity
