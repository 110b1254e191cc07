#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include "geometry/math.h"

namespace parity::cpu {

/// Where a depth may lie, as a distance: smaller is nearer in every depth mode.
struct DepthRange {
  double nearest = 0;
  double farthest = 0;
};

/// What is uncertain in the samples of a band: who is in front, and how far colours may be off.
class BandDoubt {
 public:
  /// @param cleared  distance that the depth buffer starts with.
  /// @param step     an ulp of the colour target, relative.
  BandDoubt(std::size_t pixels, std::size_t samples_per_pixel, double cleared, double step);

  /// A fragment of an element that may be seen at a sample. `maybe`: a device may leave it out, or
  /// only a device may draw it.
  void contend(std::size_t sample, std::uint32_t element, const DepthRange& depth, bool maybe);

  /// The reference has drawn this element in front.
  void set_front(std::size_t sample, std::uint32_t element, const DepthRange& depth);

  /// Whether another element may be in front.
  bool contested(std::size_t sample) const;

  /// Whether a depth test against what is in front may go either way.
  bool undecided(std::size_t sample, const DepthRange& depth) const;

  /// Whether something in this range may be seen before what is in front.
  bool may_be_seen(std::size_t sample, const DepthRange& depth) const;

  void mark(std::size_t pixel) { marked_[pixel] = 1; }

  /// A sample is given a colour with this error.
  void set_color(std::size_t sample, const dvec4& color, const dvec4& error);

  /// A layer is blended over a sample: color of the layer (RGB not multiplied by alpha) and its
  /// error, and the sample's colour before and after.
  void blend(std::size_t sample, const dvec4& layer, const dvec4& layer_error, const dvec4& before,
             const dvec4& after);

  bool ambiguous(std::size_t pixel) const;
  /// Of the resolved colour of a pixel.
  dvec4 color_bound(std::size_t pixel, const dvec4& resolved) const;
  double depth_bound(std::size_t sample) const;

 private:
  /// The two nearest elements that may be seen at a sample.
  struct Contest {
    DepthRange front;
    std::uint32_t front_element = 0xffffffff;
    std::array<std::uint32_t, 2> element{0xffffffff, 0xffffffff};
    std::array<double, 2> nearest{std::numeric_limits<double>::infinity(),
                                  std::numeric_limits<double>::infinity()};
  };

  std::size_t samples_per_pixel_;
  double step_;  ///< an ulp of a stored colour: either neighbour is right (lavapipe truncates)
  std::vector<Contest> contests_;
  std::vector<dvec4> error_;
  std::vector<std::uint8_t> marked_;
};

}  // namespace parity::cpu
