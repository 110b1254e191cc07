#include "gpu/transform/view_volume.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace parity::gpu {

std::vector<ViewVolumeRecord> volume_records(std::span<const ViewVolume> volumes, const char* who) {
  std::vector<ViewVolumeRecord> records;
  records.reserve(volumes.size());
  for (const ViewVolume& v : volumes) {
    const float across = v.right - v.left, up = v.top - v.bottom;
    if (!std::isfinite(across) || !std::isfinite(up) || across == 0 || up == 0)
      throw std::invalid_argument(std::string(who) + ": volume " + std::to_string(records.size()) +
                                  " is " + std::to_string(across) + " by " + std::to_string(up) +
                                  ", sides must be finite and not 0");
    records.push_back({v.left, v.right, v.bottom, v.top, v.near, v.far});
  }
  return records;
}

}  // namespace parity::gpu
