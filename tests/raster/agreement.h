#pragma once

#include <string>

#include "cpu_reference/raster/renderer.h"
#include "geometry/frame.h"
#include "gpu/core/context.h"
#include "gpu/raster/renderer.h"

/// The device's picture of a frame against that of the reference, pixel by pixel, by cause.
namespace parity::raster_test {

struct Agreement {
  std::size_t pixels = 0;
  std::size_t ambiguous = 0;  ///< a decision is within its error there: not judged
  std::size_t coverage = 0;   ///< something on one side, nothing on the other
  std::size_t depth = 0;      ///< another element in front, or its depth is off
  std::size_t color = 0;      ///< the same element, but a colour outside its bound
  ivec2 first{-1};            ///< the first wrong pixel
  double worst = 0;           ///< largest colour difference in units of its bound
  std::size_t wrong() const { return coverage + depth + color; }
  std::string text() const;
};

/// @param got   with elements
/// @param want  with elements and bounds
Agreement compare(const Picture& got, const cpu::Rendered& want);

/// Both sides draw the frame; the device in 32-bit floats.
Agreement draw_and_compare(gpu::Context& context, const Scene& scene, const Frame& frame);

}  // namespace parity::raster_test
