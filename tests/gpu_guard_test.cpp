#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>

#include "gpu/core/commands.h"
#include "gpu/core/faults.h"
#include "shaders.h"
#include "shaders/core/layout.h"

// What must go wrong does, and is reported: each test here plants a fault.
namespace parity {
namespace {

using gpu::Buffer;
using gpu::Commands;
using gpu::Error;
using gpu::ErrorKind;
using gpu::Guard;
using gpu::Kernel;

constexpr int count = 131;

enum class Access { write, read };

/// Accesses element `at` of a buffer of 131; returns what the guard said.
std::string touch(gpu::Context& context, Access access, int at) {
  const Kernel<TestPokeArgs> kernel(context, access == Access::write
                                                 ? gpu::shaders::core_test_poke_comp
                                                 : gpu::shaders::core_test_peek_comp);
  const Buffer<std::uint32_t> values(context, std::vector<std::uint32_t>(count, 7));
  try {
    context.run([&](Commands& commands) { commands.dispatch(kernel, {.x = 1}, {values, at, 1}); });
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::broken_guard);
    return error.what();
  }
  return "";
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(GpuGuard, ZonesNameTheBufferAndTheSide) {
  for (const bool staged : {false, true}) {
    gpu::Context context({.device = "", .guard = Guard::zones, .force_staging = staged});
    EXPECT_EQ(touch(context, Access::write, 0), "");
    EXPECT_EQ(touch(context, Access::write, count - 1), "");
    const std::string after = touch(context, Access::write, count);
    EXPECT_TRUE(contains(after, "past the end") && contains(after, "524")) << after;
    const std::string before = touch(context, Access::write, -1);
    EXPECT_TRUE(contains(before, "before the start") && contains(before, "524")) << before;
    EXPECT_EQ(touch(context, Access::write, 5), "");
  }
}

TEST(GpuGuard, NewMemoryIsNonsense) {
  for (const bool staged : {false, true}) {
    gpu::Context context({.device = "", .guard = Guard::zones, .force_staging = staged});
    EXPECT_EQ(Buffer<std::uint32_t>(context, 3).read(), std::vector<std::uint32_t>(3, 0xCDCDCDCD));
  }
}

TEST(GpuGuard, MemoryThatIsGivenBackIsNonsense) {
  gpu::Context context({.device = "", .guard = Guard::zones});
  if (context.info().type != "cpu" && context.info().type != "integrated")
    GTEST_SKIP() << "the device has memory of its own";
  const Kernel<TestPokeArgs> kernel(context, gpu::shaders::core_test_peek_comp);
  const Buffer<std::uint32_t> values(context, std::vector<std::uint32_t>(count, 7));
  std::uint64_t stale = 0;
  {
    const Buffer<std::uint32_t> gone(context, std::vector<std::uint32_t>(count, 7));
    stale = gone.raw().address();
  }
  const auto at = int((std::int64_t(stale) - std::int64_t(values.raw().address())) / 4);
  context.run([&](Commands& commands) {
    commands.dispatch(kernel, {.x = 1}, TestPokeArgs{values, at, 0});
  });
  EXPECT_EQ(values.read(0, 1)[0], 0xCDCDCDCDu);
}

/// In a process of its own, since an access past a fence ends it.
void touch_fenced(Access access, int at) {
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  std::signal(SIGSEGV, SIG_DFL);  // also under a sanitizer
  gpu::Context context({.device = "", .guard = Guard::fences});
  std::exit(touch(context, access, at).empty() ? 0 : 1);
}

bool device_can_fence() {
  for (const gpu::DeviceInfo& each : gpu::list_devices())
    if (each.refused.empty() && each.host_memory_import) return true;
  return false;
}

TEST(GpuGuardDeathTest, FencesEndTheProcessAtTheFirstStrayAccess) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  if (!device_can_fence()) GTEST_SKIP() << "no device imports host memory";
  EXPECT_EXIT(touch_fenced(Access::write, count - 1), testing::ExitedWithCode(0), "");
  EXPECT_EXIT(touch_fenced(Access::read, count - 1), testing::ExitedWithCode(0), "");
  EXPECT_EXIT(touch_fenced(Access::write, count), testing::KilledBySignal(SIGSEGV), "");
  EXPECT_EXIT(touch_fenced(Access::read, count), testing::KilledBySignal(SIGSEGV), "");
  // Before the start there is the rest of a page, watched like a zone.
  EXPECT_EXIT(touch_fenced(Access::write, -1), testing::ExitedWithCode(1), "");
}

/// In a process of its own: the loop runs on.
void spin() {
  const auto last = [](const char* what, bool good) {
    if (!good) std::fprintf(stderr, "failed: %s\n", what);
    return good;
  };
  bool good = true;
  {
    gpu::Context context({.device = "", .timeout_seconds = 0.5});
    if (context.info().cuts_loops_short) std::exit(0);
    const Kernel<TestPokeArgs> kernel(context, gpu::shaders::core_test_spin_comp);
    const Buffer<std::uint32_t> values(context, {0, 0});
    const auto run = [&]() -> std::optional<ErrorKind> {
      try {
        context.run([&](Commands& commands) {
          commands.dispatch(kernel, {.x = 1}, {values, 0, 1});
        });
      } catch (const Error& error) {
        return error.kind();
      }
      return std::nullopt;
    };
    good = last("times out", run() == ErrorKind::timed_out) && good;
    good = last("is lost after that", run() == ErrorKind::device_lost) && good;
  }
  const gpu::Context another;
  good = last("another context works", !another.info().name.empty()) && good;
  std::_Exit(good ? 0 : 1);  // what the loop uses is not to be called a leak
}

TEST(GpuGuardDeathTest, AnEndlessLoopTimesOutAndLeavesTheProcessAlive) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT((alarm(30), spin()), testing::ExitedWithCode(0), "");
}

std::vector<std::string> messages_of_two_copies(bool skip_barriers) {
  const gpu::faults::Injection injection({.skip_barriers = skip_barriers});
  gpu::Context context({.device = "", .validation = true});
  const Buffer<float> from(context, std::vector<float>(count, 1));
  const Buffer<float> to(context, count);
  context.run([&](Commands& commands) {
    commands.copy(from, to, 0, 0, count);
    commands.copy(from, to, 0, 0, count);
  });
  return context.take_validation_messages();
}

TEST(GpuGuard, TheValidationLayerReportsAMissingBarrier) {
  EXPECT_TRUE(messages_of_two_copies(false).empty());
  const std::vector<std::string> messages = messages_of_two_copies(true);
  ASSERT_FALSE(messages.empty());
  EXPECT_TRUE(contains(messages[0], "SYNC-HAZARD-WRITE-AFTER-WRITE")) << messages[0];
}

TEST(GpuGuard, TheValidationLayerReportsAccessesOutsideABuffer) {
  gpu::Context context(
      {.device = "", .validation = true, .gpu_assisted = true, .guard = Guard::zones});
  const gpu::DeviceInfo& info = context.info();
  if (info.is_swiftshader || info.cuts_loops_short)
    GTEST_SKIP() << "the layer cannot check addresses on " << info.driver;
  const auto reported = [&](Access access, int at) {
    EXPECT_EQ(touch(context, access, at), "");  // the layer keeps the access from happening
    const std::vector<std::string> messages = context.take_validation_messages();
    return std::any_of(messages.begin(), messages.end(), [](const std::string& message) {
      return contains(message, "Device address out of bounds");
    });
  };
  for (const Access access : {Access::write, Access::read}) {
    EXPECT_FALSE(reported(access, 0));
    EXPECT_FALSE(reported(access, count - 1));
    EXPECT_TRUE(reported(access, count));
    EXPECT_TRUE(reported(access, -1));
  }
}

std::size_t thread_count() {
  const std::filesystem::directory_iterator tasks("/proc/self/task");
  return static_cast<std::size_t>(std::distance(begin(tasks), end(tasks)));
}

struct Picture {
  std::vector<vec4> texels;
  std::size_t threads;  ///< of the process meanwhile
};

/// A picture of many overlapping triangles, by a driver of so many threads.
Picture picture_with(const char* driver_threads) {
  setenv("LP_NUM_THREADS", driver_threads, 1);
  gpu::Context context;
  unsetenv("LP_NUM_THREADS");
  std::vector<vec4> positions;
  std::vector<vec4> colors;
  std::uint32_t state = 1;
  const auto random = [&state] {
    state = state * 1664525u + 1013904223u;
    return static_cast<float>(state >> 8) / 8388608.0f - 1.0f;
  };
  for (int i = 0; i < 600; ++i) {
    positions.emplace_back(random(), random(), 0.5f + 0.5f * random(), 1);
    colors.emplace_back(random(), random(), random(), 1);
  }
  gpu::RasterOptions options;
  options.colors = {gpu::Format::rgba32_float};
  options.blends = {gpu::Blend::add};  // in order, or the rounding shows it
  const gpu::RasterPipeline<TestTriangleArgs> pipeline(
      context, gpu::shaders::core_test_triangle_vert, gpu::shaders::core_test_triangle_frag,
      options);
  const gpu::Image image(context, {.width = 256, .height = 256, .format = options.colors[0]});
  const Buffer<vec4> vertices(context, positions);
  const Buffer<vec4> palette(context, colors);
  const Buffer<vec4> texels(context, 256 * 256);
  context.run([&](Commands& commands) {
    commands.render({.colors = {{.image = &image, .clear = {{0, 0, 0, 0}}}}, .depth = {}},
                    [&](gpu::RenderPass& pass) {
                      pass.draw(pipeline, {vertices, palette}, 600);
                    });
    commands.copy(image, texels);
  });
  return {texels.read(), thread_count()};
}

TEST(GpuCore, ThePictureDoesNotDependOnTheNumberOfThreads) {
  const Picture alone = picture_with("0");
  EXPECT_NE(alone.texels, std::vector<vec4>(256 * 256, vec4(0)));
  if (gpu::list_devices().front().is_mesa_software) {  // else the setting does nothing
    EXPECT_GT(picture_with("4").threads, alone.threads);
  }
  for (const char* threads : {"1", "2", "4"}) {
    const Picture picture = picture_with(threads);
    EXPECT_EQ(picture.texels, alone.texels) << threads;
  }
}

}  // namespace
}  // namespace parity
