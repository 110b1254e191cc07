#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/core/buffer.h"
#include "gpu/core/commands.h"
#include "gpu/core/kernel.h"

namespace parity::gpu {

/// Runs a kernel with one thread a query: uploads, runs, reads back.
template <typename Args, typename Answer, typename Query>
std::vector<Answer> query_map(Context& context, const ShaderCode& code,
                              std::span<const Query> queries) {
  const Buffer<Query> in(context, queries);
  const Buffer<Answer> out(context, queries.size());
  const Kernel<Args> kernel(context, code);
  const auto count = static_cast<std::uint32_t>(queries.size());
  context.run([&](Commands& commands) {
    commands.dispatch(kernel, {count}, Args{in, out, count, 0});
  });
  return out.read();
}

}  // namespace parity::gpu
