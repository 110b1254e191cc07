// Signed 64-bit integers of two words: not every device has the type.
#ifndef PARITY_RASTER_WIDE_GLSL
#define PARITY_RASTER_WIDE_GLSL

struct Wide {
  int high;
  uint low;
};

Wide wide_product(int a, int b) {
  int high, low;
  imulExtended(a, b, high, low);
  return Wide(high, uint(low));
}

Wide wide_difference(Wide a, Wide b) {
  uint borrow;
  const uint low = usubBorrow(a.low, b.low, borrow);
  return Wide(a.high - b.high - int(borrow), low);
}

/// a >= 0 as 1, a < 0 as -1, a = 0 as 0.
int wide_sign(Wide a) { return a.high < 0 ? -1 : ((uint(a.high) | a.low) != 0u ? 1 : 0); }

/// floor(a / 16), at least -2^30 and at most 2^30 - 1.
int wide_sixteenth(Wide a) {
  const int above = a.high >> 2;
  if (above == 0 || above == -1) return int((uint(a.high) << 28) | (a.low >> 4));
  return above < 0 ? -(1 << 30) : (1 << 30) - 1;
}

/// Rounded to 24 bits, relative error 2^-23.
float wide_float(Wide a) {
  const bool negative = a.high < 0;
  uint high = uint(a.high), low = a.low;
  if (negative) {
    low = ~low + 1u;
    high = ~high + (low == 0u ? 1u : 0u);
  }
  precise float magnitude = float(high) * 4294967296.0 + float(low);
  return negative ? -magnitude : magnitude;
}

#endif
