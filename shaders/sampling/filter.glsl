#include "sampling/layout.h"

// Reconstruction filters: not normalised, x in px. Sources: notes 1.8; Mitchell & Netravali 1988;
// Duchon 1979.

const uint filter_box = 0u, filter_tent = 1u, filter_gaussian = 2u, filter_mitchell = 3u,
           filter_lanczos = 4u;

float filter_reach(uint kind) {
  switch (kind) {
    case filter_box: return 0.5;
    case filter_tent: return 1.0;
    case filter_lanczos: return 3.0;
    default: return 2.0;
  }
}

// sin(pi x): reduced to a quarter turn, then Taylor's series to x^11, 6e-8 off at most.
float sin_pi(float x) {
  const float whole = round(x);
  const float t = 3.14159265358979 * (x - whole), u = t * t;
  const float s = t * (1.0 + u * (-1.0 / 6.0 + u * (1.0 / 120.0 + u * (-1.0 / 5040.0 +
                  u * (1.0 / 362880.0 - u / 39916800.0)))));
  return (int(whole) & 1) == 0 ? s : -s;
}

float mitchell(float x) {
  if (x < 1.0) return (7.0 * x - 12.0) * x * x + 16.0 / 3.0;
  return ((-7.0 / 3.0 * x + 12.0) * x - 20.0) * x + 32.0 / 3.0;
}

float filter_weight(uint kind, float x) {
  x = abs(x);
  if (x > filter_reach(kind)) return 0.0;
  switch (kind) {
    case filter_box: return x == 0.5 ? 0.5 : 1.0;
    case filter_tent: return 1.0 - x;
    case filter_gaussian: return exp(-2.0 * x * x);
    case filter_mitchell: return mitchell(x);
  }
  const float turn = 9.8696044010893586 * x * x;  // pi^2 x^2
  return x < 1e-4 ? 1.0 : 3.0 * sin_pi(x) * sin_pi(x / 3.0) / turn;
}
