#pragma once

#include "gpu/core/context.h"

namespace parity {

/// The context that tests share: validated, buffers between guard zones, made at the first call. A
/// test during which the validation layer says anything fails. For other runs of the same tests:
/// PARITY_TEST_GUARD=fences, so that the first stray access, reads too, ends the process;
/// PARITY_TEST_ASSISTED=1 for GPU-assisted validation, which is slow.
gpu::Context& test_context();

}  // namespace parity
