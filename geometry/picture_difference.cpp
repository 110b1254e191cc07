#include "geometry/picture_difference.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace parity {
namespace {

double absolute_difference(double a, double b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0.0;
  if (std::isfinite(a) && std::isfinite(b)) return std::abs(a - b);
  return std::numeric_limits<double>::infinity();
}

}  // namespace

PictureDifference difference(const Grid<vec4>& a, const Grid<vec4>& b) {
  if (a.width() != b.width() || a.height() != b.height() || a.empty())
    throw std::invalid_argument("difference: sizes are " + std::to_string(a.width()) + "x" +
                                std::to_string(a.height()) + " and " + std::to_string(b.width()) +
                                "x" + std::to_string(b.height()) + ", must be equal and not 0");
  PictureDifference result;
  double sum = 0.0;
  for (int y = 0; y < a.height(); ++y)
    for (int x = 0; x < a.width(); ++x)
      for (int c = 0; c < 3; ++c) {
        const double d = absolute_difference(a(x, y)[c], b(x, y)[c]);
        sum += d * d;
        if (d > result.maximum) {
          result.maximum = d;
          result.maximum_x = x;
          result.maximum_y = y;
        }
      }
  result.mse = sum / (3.0 * double(a.size()));
  result.psnr = -10.0 * std::log10(result.mse);
  return result;
}

}  // namespace parity
