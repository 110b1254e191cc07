#include "sampling/layout.h"

// Mean of clamp(x, 0, 1) while x goes evenly from one value to another.
float mean_clamped(float from, float to) {
  const float low = min(from, to), high = max(from, to);
  if (high == low) return clamp(low, 0.0, 1.0);
  const float left = clamp(low, 0.0, 1.0), right = clamp(high, 0.0, 1.0);
  const float inside = (right - left) / (high - low), beyond = max(high - max(low, 1.0), 0.0) / (high - low);
  return inside * 0.5 * (left + right) + beyond;
}

// Area of the pixel [0, 1]^2 that lies left of the edge from a to b, between its ends' y; negative
// where the edge goes up (y falls). Summed over a closed polygon: its area within the pixel, positive
// if it is clockwise on the screen. Source: Green's theorem.
float area_beside(vec2 a, vec2 b) {
  const float low = clamp(min(a.y, b.y), 0.0, 1.0), high = clamp(max(a.y, b.y), 0.0, 1.0);
  if (high <= low) return 0.0;
  const float slope = (b.x - a.x) / (b.y - a.y);
  const float from = a.x + (low - a.y) * slope, to = a.x + (high - a.y) * slope;
  const float mean = mean_clamped(from, to);
  return a.y < b.y ? (high - low) * mean : (low - high) * mean;
}
