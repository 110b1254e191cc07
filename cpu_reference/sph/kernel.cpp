#include "cpu_reference/sph/kernel.h"

#include <cmath>
#include <numbers>

namespace parity::cpu {
namespace {

using std::numbers::pi;

/// M4 B-spline in r / h as Monaghan writes it, with its derivative.
double spline(double q) {
  if (q >= 2) return 0;
  return q >= 1 ? std::pow(2 - q, 3) / 4 : 1 - 1.5 * q * q + 0.75 * q * q * q;
}
double spline_derivative(double q) {
  if (q >= 2) return 0;
  return q >= 1 ? -0.75 * (2 - q) * (2 - q) : -3 * q + 2.25 * q * q;
}

}  // namespace

double sph_kernel(SphKernel kernel, std::uint32_t dimensions, double r, double H) {
  if (r >= H) return 0;
  const bool solid = dimensions == 3;
  const double h = H / 2;
  switch (kernel) {
    case SphKernel::cubic_spline:
      return spline(r / h) * (solid ? 1 / (pi * h * h * h) : 10 / (7 * pi * h * h));
    case SphKernel::poly6:
      return std::pow(H * H - r * r, 3) *
             (solid ? 315 / (64 * pi * std::pow(H, 9)) : 4 / (pi * std::pow(H, 8)));
    case SphKernel::spiky:
      return std::pow(H - r, 3) * (solid ? 15 / (pi * std::pow(H, 6)) : 10 / (pi * std::pow(H, 5)));
    case SphKernel::wendland: {
      const double q = r / h;
      return std::pow(1 - q / 2, 4) * (2 * q + 1) *
             (solid ? 21 / (16 * pi * h * h * h) : 7 / (4 * pi * h * h));
    }
  }
  return 0;
}

double sph_kernel_derivative(SphKernel kernel, std::uint32_t dimensions, double r, double H) {
  if (r >= H) return 0;
  const bool solid = dimensions == 3;
  const double h = H / 2;
  switch (kernel) {
    case SphKernel::cubic_spline:
      return spline_derivative(r / h) / h * (solid ? 1 / (pi * h * h * h) : 10 / (7 * pi * h * h));
    case SphKernel::poly6:
      return -6 * r * std::pow(H * H - r * r, 2) *
             (solid ? 315 / (64 * pi * std::pow(H, 9)) : 4 / (pi * std::pow(H, 8)));
    case SphKernel::spiky:
      return -3 * std::pow(H - r, 2) *
             (solid ? 15 / (pi * std::pow(H, 6)) : 10 / (pi * std::pow(H, 5)));
    case SphKernel::wendland: {
      const double q = r / h;
      return -5 * q * std::pow(1 - q / 2, 3) / h *
             (solid ? 21 / (16 * pi * h * h * h) : 7 / (4 * pi * h * h));
    }
  }
  return 0;
}

}  // namespace parity::cpu
