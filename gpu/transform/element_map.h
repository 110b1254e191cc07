#pragma once

#include <cstdint>
#include <vector>

#include "gpu/core/buffer.h"
#include "gpu/core/commands.h"
#include "gpu/core/kernel.h"

namespace parity::gpu {

/// Runs a kernel with one thread an input: uploads, runs, reads back. `parameter` is the last word
/// of the push constants.
template <typename Args, typename Output, typename Input>
std::vector<Output> element_map(Context& context, const ShaderCode& code,
                                const std::vector<Input>& inputs, std::uint32_t parameter = 0) {
  const Buffer<Input> in(context, inputs);
  const Buffer<Output> out(context, inputs.size());
  const Kernel<Args> kernel(context, code);
  const auto count = static_cast<std::uint32_t>(inputs.size());
  context.run([&](Commands& commands) {
    commands.dispatch(kernel, {count}, Args{in, out, count, parameter});
  });
  return out.read();
}

}  // namespace parity::gpu
