#include "geometry/shadow.h"

#include <cmath>

namespace parity {

std::vector<double> cascade_ends(double near, double far, int count, double logarithmic) {
  std::vector<double> ends;
  for (int i = 1; i <= count; ++i) {
    const double part = double(i) / count;
    const double steps = near + (far - near) * part;
    const double ratios = near * std::pow(far / near, part);
    ends.push_back(logarithmic * ratios + (1 - logarithmic) * steps);
  }
  return ends;
}

}  // namespace parity
