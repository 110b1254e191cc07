#pragma once

#include <span>
#include <vector>

#include "geometry/transform.h"
#include "shaders/transform/layout.h"

namespace parity::gpu {

/// @throws std::invalid_argument  a side has no length or is not finite; `who` begins the message.
std::vector<ViewVolumeRecord> volume_records(std::span<const ViewVolume> volumes, const char* who);

}  // namespace parity::gpu
