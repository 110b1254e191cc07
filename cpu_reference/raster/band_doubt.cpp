#include "cpu_reference/raster/band_doubt.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace parity::cpu {
namespace {

/// Tells an element that may be there from the same one that is.
constexpr std::uint32_t maybe_bit = 0x80000000u;
constexpr double largest_half = 65504;

}  // namespace

BandDoubt::BandDoubt(std::size_t pixels, std::size_t samples_per_pixel, double cleared, double step)
    : samples_per_pixel_(samples_per_pixel),
      step_(step),
      contests_(pixels * samples_per_pixel),
      error_(pixels * samples_per_pixel, dvec4(0.0)),
      marked_(pixels, 0) {
  for (Contest& c : contests_) c.front = {cleared, cleared};
}

void BandDoubt::contend(std::size_t sample, std::uint32_t element, const DepthRange& depth,
                        bool maybe) {
  Contest& c = contests_[sample];
  const std::uint32_t name = maybe ? element | maybe_bit : element;
  if (name == c.element[0]) {
    c.nearest[0] = std::min(c.nearest[0], depth.nearest);
  } else if (depth.nearest < c.nearest[0]) {
    if (name != c.element[1]) {
      c.element[1] = c.element[0];
      c.nearest[1] = c.nearest[0];
    } else {
      std::swap(c.element[0], c.element[1]);
      std::swap(c.nearest[0], c.nearest[1]);
    }
    c.element[0] = name;
    c.nearest[0] = depth.nearest;
  } else if (name == c.element[1] || depth.nearest < c.nearest[1]) {
    c.element[1] = name;
    c.nearest[1] = std::min(c.nearest[1], depth.nearest);
  }
}

void BandDoubt::set_front(std::size_t sample, std::uint32_t element, const DepthRange& depth) {
  contests_[sample].front = depth;
  contests_[sample].front_element = element;
}

bool BandDoubt::contested(std::size_t sample) const {
  const Contest& c = contests_[sample];
  const std::size_t other = c.element[0] == c.front_element ? 1 : 0;
  return c.nearest[other] <= c.front.farthest;
}

bool BandDoubt::undecided(std::size_t sample, const DepthRange& depth) const {
  const DepthRange& front = contests_[sample].front;
  return depth.nearest <= front.farthest && depth.farthest >= front.nearest;
}

bool BandDoubt::may_be_seen(std::size_t sample, const DepthRange& depth) const {
  return depth.nearest <= contests_[sample].front.farthest;
}

void BandDoubt::set_color(std::size_t sample, const dvec4& color, const dvec4& error) {
  error_[sample] = error + glm::abs(color) * step_;
}

void BandDoubt::blend(std::size_t sample, const dvec4& layer, const dvec4& layer_error,
                      const dvec4& before, const dvec4& after) {
  dvec4& error = error_[sample];
  const double a = layer.w;
  // The layer and the result are rounded to the target's precision.
  const dvec4 source = layer_error + glm::abs(layer) * step_;
  for (int c = 0; c < 4; ++c) {
    const double through = c < 3 ? std::abs(layer[c] - before[c]) : std::abs(1 - before.w);
    const double own = c < 3 ? source[c] * std::min(1.0, std::abs(a) + source.w) : 0.0;
    error[c] = own + through * source.w + error[c] * (std::abs(1 - a) + source.w) +
               std::abs(after[c]) * step_;
  }
}

bool BandDoubt::ambiguous(std::size_t pixel) const {
  if (marked_[pixel] != 0) return true;
  for (std::size_t s = 0; s < samples_per_pixel_; ++s)
    if (contested(pixel * samples_per_pixel_ + s)) return true;
  return false;
}

dvec4 BandDoubt::color_bound(std::size_t pixel, const dvec4& resolved) const {
  dvec4 sum{0.0};
  for (std::size_t s = 0; s < samples_per_pixel_; ++s)
    sum += error_[pixel * samples_per_pixel_ + s];
  dvec4 bound = sum / double(samples_per_pixel_);
  // A resolve is right within two ulp of the target.
  if (samples_per_pixel_ > 1) bound += glm::abs(resolved) * (2 * step_);
  for (int c = 0; c < 4; ++c)
    if (step_ > 0x1p-12 && std::abs(resolved[c]) + bound[c] > largest_half)
      bound[c] = std::numeric_limits<double>::infinity();
  return bound;
}

double BandDoubt::depth_bound(std::size_t sample) const {
  const DepthRange& front = contests_[sample].front;
  return (front.farthest - front.nearest) / 2;
}

}  // namespace parity::cpu
