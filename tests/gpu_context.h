#pragma once

#include "gpu/core/context.h"

namespace parity {

/// The context that tests share: validated, buffers between guard zones, made at the first call. A
/// test during which the validation layer says anything fails.
gpu::Context& test_context();

}  // namespace parity
