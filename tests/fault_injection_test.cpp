#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#include "gpu/core/commands.h"
#include "gpu/core/faults.h"
#include "shaders.h"
#include "shaders/core/layout.h"

// Every Vulkan call of a whole job is made to fail, one after another. In processes of their own:
// they must not die of it.
namespace parity {
namespace {

using gpu::Buffer;
using gpu::Commands;
using gpu::Error;
using gpu::ErrorKind;
using gpu::faults::Fault;

/// Uploads, kernels with and without images, drawing, and reading back: 131 * 2 + 1 if all goes
/// well.
float work(gpu::Context& context) {
  const gpu::Kernel<TestAddArgs> add(context, gpu::shaders::core_test_add_comp);
  const gpu::Kernel<TestSamplesArgs> invert(context, gpu::shaders::core_test_invert_comp);
  gpu::RasterOptions options;
  options.colors = {gpu::Format::rgba32_float};
  const gpu::RasterPipeline<TestTriangleArgs> pipeline(
      context, gpu::shaders::core_test_triangle_vert, gpu::shaders::core_test_triangle_frag,
      options);
  const gpu::ImageSampler sampler(context, {});
  const gpu::Image drawn(context, {.width = 4, .height = 4, .format = options.colors[0]});
  const gpu::Image inverted(context, {.width = 4, .height = 4, .format = options.colors[0]});
  const Buffer<float> values(context, std::vector<float>(131, 1));
  const Buffer<vec4> triangle(context,
                              {vec4(-1, -1, 0, 1), vec4(-1, 3, 0, 1), vec4(3, -1, 0, 1), vec4(0)});
  const Buffer<vec4> texels(context, 16);
  const gpu::ImageBinding images[] = {{&drawn, &sampler}, {}, {&inverted}};
  context.run([&](Commands& commands) {
    commands.pass("kernels");
    commands.dispatch(add, {.x = 131}, {values, values, 131, 1});
    commands.render({.colors = {{.image = &drawn, .clear = {{0, 0, 0, 0}}}}, .depth = {}},
                    [&](gpu::RenderPass& pass) {
                      pass.draw(pipeline, {triangle, triangle}, 3);
                    });
    commands.dispatch(invert, {4, 4}, {texels, 4, 4, 1}, images);
    commands.copy(inverted, texels);
  });
  float sum = 0;
  for (const float value : values.read()) sum += value;
  return sum + texels.read()[0].z;
}

constexpr float expected = 131 * 2 + 1;

ErrorKind kind_of(Fault fault) {
  return fault == Fault::device_lost ? ErrorKind::device_lost : ErrorKind::out_of_memory;
}

void require(bool condition, const char* what, const gpu::faults::Report& report,
             std::int64_t call) {
  if (condition) return;
  std::fprintf(stderr, "call %lld, %s: %s (%lld objects live)\n", static_cast<long long>(call),
               report.failed.c_str(), what, static_cast<long long>(report.live_objects));
  std::_Exit(1);
}

/// Runs `job` with call `n` failing; false: the job makes fewer calls.
template <typename Job>
bool fails_well(Fault fault, std::int64_t n, std::int64_t live_before, const Job& job) {
  gpu::faults::Injection injection({.fault = fault, .at_call = n});
  bool thrown = false;
  try {
    job();
  } catch (const Error& error) {
    thrown = true;
    const gpu::faults::Report report = injection.report();
    require(error.kind() == kind_of(fault), error.what(), report, n);
    require(std::string(error.what()).find(report.failed) != std::string::npos, error.what(),
            report, n);
  }
  const gpu::faults::Report report = injection.report();
  require(thrown == !report.failed.empty(), "no error came of it", report, n);
  require(report.live_objects == live_before, "something leaked", report, n);
  return thrown;
}

/// From the making of the context to its end. `step` 1: every call.
void sweep_whole(Fault fault, std::int64_t step, const gpu::ContextOptions& options) {
  alarm(120);
  const auto job = [&] {
    gpu::Context context(options);
    if (work(context) != expected) std::_Exit(2);
  };
  std::int64_t n = 1;
  while (fails_well(fault, n, 0, job)) n += step;
  job();                      // a retry
  std::exit(n > 60 ? 0 : 3);  // the job makes some eighty calls
}

/// Work in a context that keeps nothing of it, so that the counts of objects are comparable.
float work_and_forget(gpu::Context& context) {
  struct Forget {
    gpu::Context& of;
    ~Forget() { of.drop_unused_pipelines(); }
  } const forget{context};
  return work(context);
}

/// Inside one context, which must go on working.
void sweep_work(Fault fault) {
  alarm(120);
  gpu::Context context;
  std::int64_t n = 1;
  while (fails_well(fault, n, 0, [&] { static_cast<void>(work_and_forget(context)); })) {
    ++n;
    if (work_and_forget(context) != expected) std::_Exit(2);
  }
  std::exit(n > 40 ? 0 : 3);
}

class FaultInjectionDeathTest : public testing::Test {
  void SetUp() override { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
};

TEST_F(FaultInjectionDeathTest, EveryCallMayRunOutOfDeviceMemory) {
  EXPECT_EXIT(sweep_whole(Fault::out_of_device_memory, 1, {}), testing::ExitedWithCode(0), "");
}

TEST_F(FaultInjectionDeathTest, CallsMayRunOutOfHostMemory) {
  EXPECT_EXIT(sweep_whole(Fault::out_of_host_memory, 4, {}), testing::ExitedWithCode(0), "");
}

TEST_F(FaultInjectionDeathTest, CallsMayLoseTheDevice) {
  EXPECT_EXIT(sweep_whole(Fault::device_lost, 4, {}), testing::ExitedWithCode(0), "");
}

TEST_F(FaultInjectionDeathTest, CallsMayFailWithGuardsAndStaging) {
  EXPECT_EXIT(sweep_whole(Fault::out_of_device_memory, 8,
                          {.device = "", .guard = gpu::Guard::zones, .force_staging = true}),
              testing::ExitedWithCode(0), "");
}

TEST_F(FaultInjectionDeathTest, AContextGoesOnAfterItRanOutOfMemory) {
  EXPECT_EXIT(sweep_work(Fault::out_of_device_memory), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace parity
