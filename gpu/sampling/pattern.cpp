#include "gpu/sampling/pattern.h"

#include <stdexcept>
#include <string>

#include "gpu/core/buffer.h"
#include "gpu/core/commands.h"
#include "gpu/core/kernel.h"
#include "shaders.h"
#include "shaders/sampling/layout.h"

namespace parity::gpu {
namespace {

std::vector<vec2> blue_noise(Context& context, std::uint32_t count, std::uint32_t seed) {
  const Kernel<BlueNoiseArgs> kernel(context, shaders::sampling_blue_noise_comp);
  const Buffer<uvec2> places(context, count);
  context.run([&](Commands& commands) {
    for (std::uint32_t i = 0; i < count; ++i)
      commands.dispatch(kernel, {32}, BlueNoiseArgs{.places = places, .done = i, .seed = seed});
  });
  std::vector<vec2> samples;
  for (const uvec2& place : places.read()) samples.push_back(vec2(place) * 0x1p-15f);
  return samples;
}

}  // namespace

std::vector<vec2> pattern(Context& context, SamplePattern pattern, std::uint32_t count,
                          std::uint32_t seed) {
  const bool is_blue = pattern == SamplePattern::blue_noise;
  const std::uint32_t most = is_blue ? 4096 : 1u << 20;
  if (count < 1 || count > most)
    throw std::invalid_argument("gpu::pattern: count is " + std::to_string(count) +
                                ", must be 1 to " + std::to_string(most));
  if (is_blue) return blue_noise(context, count, seed);
  const Kernel<PatternArgs> kernel(context, shaders::sampling_pattern_comp);
  const Buffer<vec2> samples(context, count);
  context.run([&](Commands& commands) {
    commands.dispatch(kernel, {count},
                      PatternArgs{.samples = samples,
                                  .pattern = std::uint32_t(pattern),
                                  .count = count,
                                  .columns = strata(count).x,
                                  .seed = seed});
  });
  return samples.read();
}

}  // namespace parity::gpu
