#pragma once

#include <map>
#include <utility>
#include <vector>

#include "geometry/grid.h"
#include "geometry/math.h"
#include "gpu/core/buffer.h"
#include "gpu/core/commands.h"
#include "gpu/core/kernel.h"
#include "shaders/sampling/layout.h"

namespace parity::gpu {

/// Fourier transforms of complex pictures of one size: the factors 4, 2, 3 and 5 of a side as
/// butterflies in registers, other primes as sums. The outputs come out in order, without a bit
/// reversal.
///
/// Mathematics: cpu::fourier_transform. Precision: the relative error in the 2-norm is at most
/// fourier_error_bound.
class FourierTransform {
 public:
  /// @param inverse  the transform with exp(+2 pi i ...), divided by the number of pixels.
  /// @throws std::invalid_argument  a side outside 1..16384.
  FourierTransform(Context& context, int width, int height, bool inverse);

  /// Transforms `data` (row-major, width x height) in place.
  void record(Commands& commands, const Buffer<vec2>& data);

 private:
  struct Pass {
    bool along_x = true;
    std::uint32_t radix = 2;
    std::uint32_t done = 1;
  };
  void plan(bool along_x, std::uint32_t count);

  uvec2 size_;
  bool inverse_;
  std::vector<Pass> passes_;
  std::map<std::uint32_t, Kernel<SpectrumArgs>> butterflies_;  ///< by radix
  Kernel<SpectrumArgs> prime_;
  Buffer<vec2> roots_x_, roots_y_;
  Buffer<vec2> other_;
};

/// The factors of the passes over a line: 4 while it goes, then 2, 3, 5, then the other primes.
std::vector<std::uint32_t> fourier_radices(std::uint32_t count);

/// Bound of ||error|| / ||answer|| of a transform of that size.
///
/// A pass of radix r sums r products with roots that are rounded once or twice: its error is at
/// most (r + 6) 2^-24 of the sum of the magnitudes, which is at most sqrt(r) of their 2-norm.
/// Source: Higham 2002, "Accuracy and Stability of Numerical Algorithms", 24.1.
double fourier_error_bound(int width, int height);

/// Uploads, transforms, reads back.
Grid<vec2> fourier_transform(Context& context, const Grid<vec2>& values, bool inverse);

}  // namespace parity::gpu
