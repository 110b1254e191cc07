#include "gpu/sampling/temporal.h"

#include <stdexcept>

#include "shaders.h"

namespace parity::gpu {

TemporalAccumulation::TemporalAccumulation(Context& context)
    : kernel_(context, shaders::sampling_temporal_comp) {}

void TemporalAccumulation::record(Commands& commands, const TemporalArgs& args) {
  commands.dispatch(kernel_, {args.width, args.height}, args);
}

Grid<vec4> accumulate(Context& context, const TemporalStep& step) {
  const std::size_t size = step.current.size();
  if (size == 0 || step.history.size() != size || step.motion.size() != size ||
      step.history.width() != step.current.width() || step.motion.width() != step.current.width() ||
      !(step.longest >= 1))
    throw std::invalid_argument(
        "gpu::accumulate: pictures must be of one size above 0, longest at least 1");
  TemporalAccumulation accumulation(context);
  const Buffer<vec4> current(context, step.current.values());
  const Buffer<vec4> history(context, step.history.values());
  const Buffer<vec2> motion(context, step.motion.values());
  const Buffer<vec4> result(context, size);
  context.run([&](Commands& commands) {
    accumulation.record(commands, {.current = current,
                                   .history = history,
                                   .motion = motion,
                                   .result = result,
                                   .width = std::uint32_t(step.current.width()),
                                   .height = std::uint32_t(step.current.height()),
                                   .longest = step.longest,
                                   .clamps = step.clamps ? 1u : 0u});
  });
  Grid<vec4> answer{step.current.width(), step.current.height()};
  answer.values() = result.read();
  return answer;
}

}  // namespace parity::gpu
