#pragma once

#include <memory>
#include <span>
#include <vector>

#include "geometry/frame.h"
#include "geometry/scene.h"
#include "geometry/texture_levels.h"
#include "gpu/core/context.h"

namespace parity::gpu {

/// Pictures of a scene with more samples than one a pixel, other than by MSAA.
///
/// Source: notes 1.8; Haeberli & Akeley 1990 (accumulation); Mitchell 1987 (adaptive).
class Antialiaser {
 public:
  /// @param levels  what the frames to come read of each image, wherever they are moved to
  ///                (read_levels); none: all.
  /// @throws Error  the scene does not fit the device.
  Antialiaser(Context& context, const Scene& scene, std::vector<LevelRange> levels = {});
  ~Antialiaser();
  Antialiaser(Antialiaser&&) noexcept;
  Antialiaser& operator=(Antialiaser&&) noexcept;

  /// The mean of the frame moved by each of the shifts (px, relative to the pixel's middle): all
  /// samples are shaded.
  ///
  /// @param frame  of the scene, with a sample count that the device itself offers.
  /// @return       colour only.
  /// @throws std::invalid_argument  no shift; a sample count that the device does not offer.
  Picture accumulate(const Frame& frame, std::span<const dvec2> shifts);

  /// One sample a pixel; where it differs on the screen from a pixel around it, 16: of these each
  /// four that show one triangle share a shade. The others' means follow from the middles around
  /// them.
  ///
  /// @param frame     1 sample a pixel.
  /// @param contrast  of gamma-2 display values of any channel or of alpha, 0 to 1; pixels with
  /// more
  ///                  are refined.
  /// @param gain      of the display, linear.
  /// @return          colour only.
  /// @throws std::invalid_argument  samples not 1.
  Picture adaptive(const Frame& frame, float contrast, float gain);

  /// Share of the pixels that the last adaptive() refined.
  double refined() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace parity::gpu
