#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <numeric>
#include <optional>
#include <string>

#include "gpu/core/commands.h"
#include "gpu/core/faults.h"
#include "shaders.h"
#include "shaders/core/layout.h"
#include "tests/gpu_context.h"

namespace parity {
namespace {

using gpu::Buffer;
using gpu::Commands;
using gpu::Error;
using gpu::ErrorKind;
using gpu::Kernel;

template <typename F>
std::optional<ErrorKind> kind_of_error(const F& function) {
  try {
    function();
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.kind();
  }
  return std::nullopt;
}

std::vector<float> counting(std::size_t count) {
  std::vector<float> values(count);
  std::iota(values.begin(), values.end(), 0.0f);
  return values;
}

std::vector<float> add_on_device(gpu::Context& context, const std::vector<float>& values,
                                 float addend, const std::vector<gpu::Specialization>& constants) {
  const Kernel<TestAddArgs> kernel(context, gpu::shaders::core_test_add_comp, constants);
  const Buffer<float> in(context, values);
  const Buffer<float> out(context, values.size());
  const auto count = static_cast<std::uint32_t>(values.size());
  context.run([&](Commands& commands) {
    commands.dispatch(kernel, {.x = count},
                      {.values = in, .results = out, .count = count, .addend = addend});
  });
  return out.read();
}

TEST(GpuCore, RunsAKernelOnAnySize) {
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{131}}) {
    std::vector<float> expected = counting(count);
    for (float& value : expected) value += 2;
    EXPECT_EQ(add_on_device(test_context(), counting(count), 2, {}), expected) << count;
  }
}

TEST(GpuCore, TheWorkgroupCanBeSpecialized) {
  std::vector<float> expected = counting(131);
  for (float& value : expected) value += 1;
  EXPECT_EQ(add_on_device(test_context(), counting(131), 1, {{.id = 0, .value = 32}}), expected);
}

TEST(GpuCore, RefusesAWorkgroupThatIsTooLarge) {
  const auto make = [](std::uint32_t size) {
    return kind_of_error([&] {
      Kernel<TestAddArgs>(test_context(), gpu::shaders::core_test_add_comp,
                          {{.id = 0, .value = size}});
    });
  };
  EXPECT_EQ(make(1u << 20), ErrorKind::missing_feature);
  EXPECT_EQ(make(0), ErrorKind::missing_feature);
}

TEST(GpuCore, RefusesArgsOfAnotherSizeNamingBoth) {
  static_assert(sizeof(TestAddArgs) == 24 && sizeof(TestPokeArgs) == 16);
  try {
    Kernel<TestPokeArgs>(test_context(), gpu::shaders::core_test_add_comp);
    FAIL() << "accepted";
  } catch (const Error& error) {
    const std::string what = error.what();
    EXPECT_EQ(error.kind(), ErrorKind::invalid_shader);
    EXPECT_NE(what.find("16"), std::string::npos) << what;
    EXPECT_NE(what.find("24"), std::string::npos) << what;
  }
}

TEST(GpuCore, BuildsEachPipelineOnce) {
  gpu::Context context;
  const auto add_first = [&](const std::vector<gpu::Specialization>& constants) {
    return add_on_device(context, {1}, 2, constants).at(0);
  };
  EXPECT_EQ(add_first({}), 3);
  const std::size_t one = context.pipeline_count();
  EXPECT_EQ(add_first({}), 3);
  EXPECT_EQ(context.pipeline_count(), one);
  EXPECT_EQ(add_first({{.id = 0, .value = 32}}), 3);
  EXPECT_EQ(add_first({{.id = 0, .value = 16}}), 3);
  EXPECT_EQ(context.pipeline_count(), one + 2);
  gpu::RasterOptions options{.colors = {gpu::Format::rgba32_float}};
  const auto draw = [&] {
    return gpu::RasterPipeline<TestTriangleArgs>(context, gpu::shaders::core_test_triangle_vert,
                                                 gpu::shaders::core_test_triangle_frag, options);
  };
  draw(), draw();
  EXPECT_EQ(context.pipeline_count(), one + 3);
  options.blends = {gpu::Blend::add};
  draw();
  EXPECT_EQ(context.pipeline_count(), one + 4);
}

TEST(GpuCore, DropsOnlyPipelinesThatNothingUses) {
  gpu::Context context;
  const Kernel<TestAddArgs> kept(context, gpu::shaders::core_test_add_comp);
  add_on_device(context, {1}, 2, {{.id = 0, .value = 32}});
  context.drop_unused_pipelines();
  EXPECT_EQ(context.pipeline_count(), 1u);
  const Buffer<float> values(context, counting(3));
  context.run([&](Commands& commands) {
    commands.dispatch(kept, {.x = 3}, {values, values, 3, 1});
  });
  EXPECT_EQ(values.read(), (std::vector<float>{1, 2, 3}));
}

// The cache must not answer for a shader whose words or arguments differ.
TEST(GpuCore, ACachedPipelineIsNotAnswerForAnother) {
  const Kernel<TestAddArgs> add(test_context(), gpu::shaders::core_test_add_comp);
  EXPECT_EQ(
      kind_of_error([] { Kernel<TestPokeArgs>(test_context(), gpu::shaders::core_test_add_comp); }),
      ErrorKind::invalid_shader);
  std::vector<std::uint32_t> words(gpu::shaders::core_test_add_comp.words.begin(),
                                   gpu::shaders::core_test_add_comp.words.end());
  words[0] = 0;
  EXPECT_EQ(kind_of_error([&] {
              Kernel<TestAddArgs>(test_context(), {gpu::shaders::core_test_add_comp.name, words});
            }),
            ErrorKind::invalid_shader);
}

TEST(GpuCore, BuffersKeepWhatIsWritten) {
  for (const bool staged : {false, true}) {
    gpu::Context context({.device = "", .guard = gpu::Guard::zones, .force_staging = staged});
    // More than one part of the staging buffer, and not a multiple of it.
    const std::vector<float> values = counting(1'500'007);
    Buffer<float> buffer(context, values);
    EXPECT_EQ(buffer.read(), values);
    buffer.write(std::vector<float>{-1, -2, -3}, 1'200'000);
    EXPECT_EQ(buffer.read(1'199'999, 5), (std::vector<float>{1'199'999, -1, -2, -3, 1'200'003}));
    EXPECT_EQ(add_on_device(context, counting(3), 1, {}), (std::vector<float>{1, 2, 3}));
    // Bytes need not be a multiple of 4.
    const std::vector<std::uint8_t> bytes{1, 2, 3, 4, 5};
    EXPECT_EQ(Buffer<std::uint8_t>(context, bytes).read(), bytes);
  }
}

TEST(GpuCore, BuffersRefuseRangesOutsideThem) {
  Buffer<float> buffer(test_context(), 3);
  EXPECT_THROW(buffer.read(2, 2), std::invalid_argument);
  EXPECT_THROW(buffer.write(std::vector<float>(4)), std::invalid_argument);
  EXPECT_THROW(buffer.read(std::numeric_limits<std::size_t>::max(), 2), std::invalid_argument);
  EXPECT_TRUE(buffer.read(3, 0).empty());
}

TEST(GpuCore, MovedBuffersStayTheSame) {
  Buffer<float> first(test_context(), counting(3));
  const std::uint64_t address = first.ref().address;
  Buffer<float> second(std::move(first));
  Buffer<float> third;
  third = std::move(second);
  EXPECT_EQ(third.ref().address, address);
  EXPECT_EQ(third.ref(2).address, address + 8);
  EXPECT_EQ(third.read(), counting(3));
}

TEST(GpuCore, BuffersOfAbsurdSizeAreOutOfMemory) {
  const auto make = [](std::size_t count) {
    return kind_of_error([&] { Buffer<float>(test_context(), count); });
  };
  EXPECT_EQ(make(std::size_t{1} << 42), ErrorKind::out_of_memory);
  EXPECT_EQ(make(std::size_t{1} << 62), ErrorKind::out_of_memory);  // 4 << 62 is 0 in 64 bits
  EXPECT_EQ(make(std::numeric_limits<std::size_t>::max()), ErrorKind::out_of_memory);
}

TEST(GpuCore, TogetherBuffersMayNotExceedTheHeap) {
  gpu::Context context;
  std::vector<Buffer<std::uint8_t>> buffers;
  const std::uint64_t most = context.info().memory_bytes / context.info().max_buffer_bytes + 1;
  const auto fill = [&] {
    for (std::uint64_t i = 0; i < most; ++i)
      buffers.emplace_back(context, context.info().max_buffer_bytes);
  };
  EXPECT_EQ(kind_of_error(fill), ErrorKind::out_of_memory);
  buffers.clear();
  EXPECT_EQ(add_on_device(context, counting(3), 1, {}), (std::vector<float>{1, 2, 3}));
}

TEST(GpuCore, GivesLargeMemoryBack) {
  const gpu::faults::Injection injection({});
  gpu::Context context;
  const std::int64_t before = injection.report().live_objects;
  const auto allocate = [&] { return Buffer<float>(context, std::size_t{4} << 20); };
  {
    const Buffer<float> large = allocate();
    EXPECT_EQ(injection.report().live_objects, before + 2);  // a buffer and its memory
  }
  EXPECT_EQ(injection.report().live_objects, before);
}

TEST(GpuCore, CountsTheBytesThatLive) {
  gpu::Context& context = test_context();
  const std::uint64_t before = context.memory_bytes();
  {
    const Buffer<float> a(context, 100);
    const Buffer<float> b(context, 31);
    EXPECT_EQ(context.memory_bytes(), before + 4 * 131);
  }
  EXPECT_EQ(context.memory_bytes(), before);
  EXPECT_GE(context.peak_memory_bytes(), before + 4 * 131);
}

TEST(GpuCore, ManyBuffersOfAllSizesShareMemory) {
  std::vector<Buffer<std::uint32_t>> buffers;
  for (std::uint32_t i = 0; i < 200; ++i) {
    buffers.emplace_back(test_context(), std::vector<std::uint32_t>(1 + i * i % 977, i));
    if (i % 3 == 2) buffers.erase(buffers.begin() + static_cast<std::ptrdiff_t>(i) / 3);
  }
  for (const Buffer<std::uint32_t>& buffer : buffers) {
    const std::vector<std::uint32_t> values = buffer.read();
    EXPECT_EQ(values, std::vector<std::uint32_t>(1 + values[0] * values[0] % 977, values[0]));
  }
}

TEST(GpuCore, CopiesAndFills) {
  const Buffer<float> from(test_context(), counting(131));
  const Buffer<float> to(test_context(), 5);
  test_context().run([&](Commands& commands) {
    commands.fill(to, 0x3F800000);  // 1.0f
    commands.copy(from, to, 127, 1, 3);
  });
  EXPECT_EQ(to.read(), (std::vector<float>{1, 127, 128, 129, 1}));
  const auto copy = [&](std::size_t first_from, std::size_t first_to, std::size_t count) {
    test_context().run(
        [&](Commands& commands) { commands.copy(from, to, first_from, first_to, count); });
  };
  EXPECT_THROW(copy(129, 0, 3), std::invalid_argument);
  EXPECT_THROW(copy(0, 4, 2), std::invalid_argument);
  copy(0, 0, 0);
}

TEST(GpuCore, DispatchesSeeWhatThoseBeforeThemWrote) {
  const Kernel<TestAddArgs> kernel(test_context(), gpu::shaders::core_test_add_comp);
  const Buffer<float> values(test_context(), counting(131));
  test_context().run([&](Commands& commands) {
    for (int i = 0; i < 100; ++i) commands.dispatch(kernel, {.x = 131}, {values, values, 131, 1});
  });
  std::vector<float> expected = counting(131);
  for (float& value : expected) value += 100;
  EXPECT_EQ(values.read(), expected);
}

TEST(GpuCore, DispatchesAsManyGroupsAsTheDeviceWrote) {
  const Kernel<TestAddArgs> kernel(test_context(), gpu::shaders::core_test_add_comp);
  const Buffer<std::uint32_t> groups(test_context(), {7, 2, 1, 1});
  const Buffer<float> values(test_context(), counting(200));
  test_context().run([&](Commands& commands) {
    commands.dispatch_indirect(kernel, groups, 1, {values, values, 200, 1000});
  });
  std::vector<float> expected = counting(200);
  for (std::size_t i = 0; i < 128; ++i) expected[i] += 1000;  // two groups of 64
  EXPECT_EQ(values.read(), expected);
  EXPECT_THROW(test_context().run([&](Commands& commands) {
    commands.dispatch_indirect(kernel, groups, 2, {values, values, 200, 1000});
  }),
               std::invalid_argument);
}

TEST(GpuCore, RefusesMoreGroupsThanTheDeviceTakes) {
  const Kernel<TestPokeArgs> kernel(test_context(), gpu::shaders::core_test_poke_comp);
  const Buffer<std::uint32_t> values(test_context(), 1);
  EXPECT_THROW(test_context().run([&](Commands& commands) {
    commands.dispatch(kernel, {.x = 1, .y = 0xFFFFFFFF}, {values, 0, 1});
  }),
               std::invalid_argument);
}

TEST(GpuCore, AFailedRecordingLeavesTheContextUsable) {
  EXPECT_THROW(test_context().run([](Commands&) { throw std::runtime_error("changed my mind"); }),
               std::runtime_error);
  EXPECT_THROW(test_context().run([](Commands&) { test_context().run([](Commands&) {}); }),
               std::invalid_argument);
  EXPECT_EQ(add_on_device(test_context(), counting(2), 1, {}), (std::vector<float>{1, 2}));
}

TEST(GpuCore, TimesTheWholeAndEachPass) {
  if (!test_context().info().timestamps) GTEST_SKIP() << "the device has no clock";
  const Kernel<TestAddArgs> kernel(test_context(), gpu::shaders::core_test_add_comp);
  const Buffer<float> values(test_context(), counting(100'000));
  const gpu::Timing timing = test_context().run([&](Commands& commands) {
    for (int pass = 0; pass < 100; ++pass) {  // more than one pool of queries
      commands.pass("pass " + std::to_string(pass));
      commands.dispatch(kernel, {.x = 100'000}, {values, values, 100'000, 1});
    }
  });
  ASSERT_EQ(timing.passes.size(), 100u);
  EXPECT_EQ(timing.passes[99].first, "pass 99");
  double sum = 0;
  for (const auto& [name, seconds] : timing.passes) {
    EXPECT_GE(seconds, 0) << name;
    sum += seconds;
  }
  EXPECT_GT(timing.seconds, 0);
  EXPECT_LE(sum, timing.seconds * (1 + 1e-12));  // 100 roundings of a sum in double
  EXPECT_LT(timing.seconds, 10);
}

TEST(GpuCore, AddsUpTheSecondsOfItsRuns) {
  gpu::Context context;
  const Buffer<float> values(context, counting(1000));
  double seconds = context.device_seconds();
  for (int run = 0; run < 3; ++run)
    seconds += context.run([&](Commands& commands) { commands.fill(values, 0); }).seconds;
  EXPECT_GT(seconds, 0);
  EXPECT_EQ(context.device_seconds(), seconds);
}

TEST(GpuCore, ChoosesDevicesByIndexAndName) {
  const std::vector<gpu::DeviceInfo> devices = gpu::list_devices();
  ASSERT_FALSE(devices.empty());
  const gpu::DeviceInfo& info = test_context().info();
  EXPECT_EQ(gpu::Context({.device = std::to_string(info.index)}).info().name, info.name);
  std::string name = info.name.substr(0, 5);
  for (char& c : name) c = static_cast<char>(std::toupper(c));
  EXPECT_EQ(gpu::Context({.device = name}).info().name, info.name);
  for (const char* missing : {"no such device", "99", "-1"})
    EXPECT_EQ(kind_of_error([&] { gpu::Context({.device = missing}); }), ErrorKind::no_device);
}

/// An environment variable for as long as it lives.
class Environment {
 public:
  Environment(const char* name, const char* value) : name_(name) {
    if (const char* old = std::getenv(name)) old_ = old;
    setenv(name, value, 1);
  }
  ~Environment() {
    if (old_)
      setenv(name_, old_->c_str(), 1);
    else
      unsetenv(name_);
  }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  const char* name_;
  std::optional<std::string> old_;
};

TEST(GpuCore, TheEnvironmentChoosesTheDeviceUnlessTheCallerDoes) {
  const std::string index = std::to_string(test_context().info().index);
  const Environment environment("PARITY_DEVICE", "no such device");
  EXPECT_EQ(kind_of_error([] { gpu::Context(); }), ErrorKind::no_device);
  EXPECT_EQ(kind_of_error([&] { gpu::Context({.device = index}); }), std::nullopt);
}

TEST(GpuCore, SaysThatThereIsNoDriver) {
  const Environment files("VK_DRIVER_FILES", "/nonexistent/driver.json");
  const Environment old_name("VK_ICD_FILENAMES", "/nonexistent/driver.json");
  EXPECT_EQ(kind_of_error([] { gpu::Context(); }), ErrorKind::no_driver);
  EXPECT_EQ(kind_of_error([] { gpu::list_devices(); }), ErrorKind::no_driver);
}

TEST(GpuCore, TheDeviceSaysWhatItIs) {
  const gpu::DeviceInfo& info = test_context().info();
  EXPECT_FALSE(info.name.empty());
  EXPECT_TRUE(info.refused.empty());
  EXPECT_GE(info.subpixel_bits, 4);  // the least that Vulkan allows
  EXPECT_GE(info.max_workgroup_invocations, 128);
  EXPECT_GT(info.max_buffer_bytes, std::uint64_t{1} << 27);
  EXPECT_EQ(info.sample_counts.front(), 1);
  const bool old_mesa = info.is_mesa_software && info.driver.find("Mesa 22.") != std::string::npos;
  EXPECT_EQ(info.cuts_loops_short, old_mesa);
}

TEST(GpuCore, RefusesWhatIsNoShader) {
  const std::vector<std::uint32_t> words{1, 2, 3};
  EXPECT_EQ(kind_of_error([&] {
              Kernel<TestPokeArgs>(test_context(), {"words", words});
            }),
            ErrorKind::invalid_shader);
}

}  // namespace
}  // namespace parity
