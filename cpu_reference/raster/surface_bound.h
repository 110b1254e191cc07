#pragma once

namespace parity::cpu {

/// What a device may do differently from exact arithmetic. The defaults are Vulkan's limits on the
/// drivers that Parity is checked with.
struct DeviceLimits {
  int sub_pixel_bits = 8;
  int sub_texel_bits = 8;
  double lod_low = -0.0431;  ///< measured: piecewise-linear log2 of the fragment's scale factor
  double lod_high = 0.0;
  double srgb_decode_codes = 0.5;  ///< error of decoding a texel, in codes of 8 bits
  bool half_color = true;          ///< colour targets of 16-bit floats, else 32
};

}  // namespace parity::cpu
