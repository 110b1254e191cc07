#include "geometry/mip_pyramid.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace parity {

std::vector<MipLevel> mip_levels(int width, int height) {
  if (width < 1 || height < 1)
    throw std::invalid_argument("mip_levels: size is " + std::to_string(width) + "x" +
                                std::to_string(height) + ", sides must be at least 1");
  std::vector<MipLevel> levels{{width, height, 0}};
  while (levels.back().width > 1 || levels.back().height > 1) {
    const MipLevel& above = levels.back();
    levels.push_back({std::max(1, above.width / 2), std::max(1, above.height / 2),
                      above.first + std::size_t(above.width) * std::size_t(above.height)});
  }
  return levels;
}

}  // namespace parity
