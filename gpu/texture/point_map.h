#pragma once

#include <span>
#include <vector>

#include "gpu/core/buffer.h"
#include "gpu/core/commands.h"
#include "gpu/core/kernel.h"
#include "shaders/texture/layout.h"

namespace parity::gpu {

struct PointMapOptions {
  std::uint32_t kind = 0;
  std::vector<std::uint32_t> permutation = {};  ///< empty: the kernel reads none
};

/// Runs a kernel with one thread a point: uploads, runs, reads back.
inline std::vector<vec4> point_map(Context& context, const ShaderCode& code,
                                   std::span<const vec3> points, const PointMapOptions& options) {
  std::vector<vec4> inputs;
  for (const vec3& p : points) inputs.emplace_back(p, 0.0f);
  const Buffer<vec4> in(context, inputs), out(context, inputs.size());
  const Buffer<std::uint32_t> permutation(context, options.permutation);
  const Kernel<PointMapArgs> kernel(context, code);
  const auto count = static_cast<std::uint32_t>(inputs.size());
  context.run([&](Commands& commands) {
    commands.dispatch(kernel, {count}, {in, out, permutation, count, options.kind});
  });
  return out.read();
}

}  // namespace parity::gpu
