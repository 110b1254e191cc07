#pragma once

#include <memory>
#include <vector>

#include "gpu/core/context.h"
#include "gpu/core/shader.h"

namespace parity::gpu {

/// A compute pipeline. Use Kernel<Args>. Built once in a context: a second one of the same shader
/// and specializations shares it.
class RawKernel {
 public:
  RawKernel(Context& context, const ShaderCode& code, std::size_t args_bytes,
            const std::vector<Specialization>& specializations);

  struct State;  // for gpu/core only
  const State* state() const { return state_.get(); }

 private:
  std::shared_ptr<const State> state_;
};

/// A compute pipeline whose push constants are one `Args` of a layout.h.
///
/// @throws Error  the size of Args is not that of the shader's push constants, the workgroup is
///                larger than the device's, or the module is no SPIR-V.
template <typename Args>
class Kernel {
 public:
  Kernel(Context& context, const ShaderCode& code,
         const std::vector<Specialization>& specializations = {})
      : raw_(context, code, sizeof(Args), specializations) {}
  const RawKernel& raw() const { return raw_; }

 private:
  RawKernel raw_;
};

}  // namespace parity::gpu
