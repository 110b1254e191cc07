#include "cpu_reference/raster/viewport.h"

#include <algorithm>
#include <cmath>

namespace parity::cpu {
namespace {

/// A vertex clipped out of very large numbers may miss the guard band by more than rounding of its
/// own size. It stays near: 2^24 steps from the origin. NaN goes there, too.
constexpr float farthest = 0x1p24f;

/// Round to nearest, ties to even: the default rounding mode.
int nearest(float value) {
  return int(std::nearbyint(std::max(-farthest, std::min(farthest, value))));
}

int snap_mesa(float coordinate, float reciprocal_w, float half_size, int samples) {
  const float ndc = coordinate * reciprocal_w;
  const float window = std::fma(ndc, half_size, half_size);
  return nearest((samples == 1 ? window - 0.5f : window) * 256.0f);
}

int snap_swiftshader(float coordinate, float reciprocal_w, float half_size) {
  const float steps = 16.0f;
  const float origin = half_size * steps - 0.5f * steps;
  const float offset = coordinate * reciprocal_w * (half_size * steps);
  return nearest(origin + offset);
}

}  // namespace

std::vector<dvec4> to_window(std::span<const vec4> clip, int width, int height) {
  std::vector<dvec4> window;
  window.reserve(clip.size());
  for (const vec4& p : clip) {
    const dvec4 position{p};
    const dvec3 ndc = dvec3(position) / position.w;
    window.emplace_back((ndc.x + 1.0) * 0.5 * width, (ndc.y + 1.0) * 0.5 * height, ndc.z,
                        1.0 / position.w);
  }
  return window;
}

SampleGrid sample_grid(int samples, Snapping snapping) {
  const bool mesa = snapping == Snapping::mesa;
  SampleGrid grid{.step_bits = mesa ? 8 : 4,
                  .steps = mesa ? 256 : 16,
                  .places = standard_sample_places(samples)};
  const int steps_per_place = grid.steps / 16;
  const int shift = mesa && samples > 1 ? 0 : grid.steps / 2;
  for (ivec2& place : grid.places) place = place * steps_per_place - ivec2(shift);
  grid.lowest = grid.highest = grid.places.front();
  for (const ivec2& place : grid.places) {
    grid.lowest = glm::min(grid.lowest, place);
    grid.highest = glm::max(grid.highest, place);
  }
  return grid;
}

ivec2 snap(vec4 clip, int width, int height, int samples, Snapping snapping) {
  const float reciprocal_w = 1.0f / clip.w;
  const float half_width = 0.5f * float(width);
  const float half_height = 0.5f * float(height);
  if (snapping == Snapping::mesa)
    return {snap_mesa(clip.x, reciprocal_w, half_width, samples),
            snap_mesa(clip.y, reciprocal_w, half_height, samples)};
  return {snap_swiftshader(clip.x, reciprocal_w, half_width),
          snap_swiftshader(clip.y, reciprocal_w, half_height)};
}

}  // namespace parity::cpu
