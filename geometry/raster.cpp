#include "geometry/raster.h"

#include <stdexcept>
#include <string>

namespace parity {

std::vector<ivec2> standard_sample_places(int samples) {
  switch (samples) {
    case 1:
      return {{8, 8}};
    case 2:
      return {{12, 12}, {4, 4}};
    case 4:
      return {{6, 2}, {14, 6}, {2, 10}, {10, 14}};
    case 8:
      return {{9, 5}, {7, 11}, {13, 9}, {5, 3}, {3, 13}, {1, 7}, {11, 15}, {15, 1}};
    default:
      throw std::invalid_argument("standard_sample_places: samples is " + std::to_string(samples) +
                                  ", must be 1, 2, 4 or 8");
  }
}

}  // namespace parity
