#include "gpu/core/vulkan_state.h"
#include "shaders.h"
#include "shaders/core/layout.h"

namespace parity::gpu {
namespace {

constexpr std::uint32_t single_count = 65536;
constexpr std::uint32_t nested_count = 300;

/// What the shader's loops of `count` steps must come to.
std::uint32_t steps(std::uint32_t count) {
  std::uint32_t value = 0;
  for (std::uint32_t i = 0; i < count; ++i) value = value * 1664525u + 1013904223u;
  return value;
}

}  // namespace

bool cuts_loops_short(Context& context) {
  const Kernel<CanaryArgs> kernel(context, shaders::core_canary_comp);
  const Buffer<std::uint32_t> results(context, 2);
  context.run([&](Commands& commands) {
    commands.dispatch(
        kernel, {.x = 1},
        {.results = results, .single_count = single_count, .nested_count = nested_count});
  });
  return results.read() !=
         std::vector<std::uint32_t>{steps(single_count), steps(nested_count * nested_count)};
}

}  // namespace parity::gpu
