#pragma once

#include "sim/sph.h"

namespace parity::cpu {

/// W(r, H), 1/m^d: its integral over space is 1; 0 from H on.
///
/// Source: notes 10.4; Monaghan 1992 (cubic spline, H = 2 h); Müller, Charypar & Gross 2003 (poly6,
/// spiky; in 2 dimensions with their integrals there); Wendland 1995 (C2).
double sph_kernel(SphKernel kernel, std::uint32_t dimensions, double r, double support);

/// dW/dr, 1/m^(d+1).
double sph_kernel_derivative(SphKernel kernel, std::uint32_t dimensions, double r, double support);

}  // namespace parity::cpu
