#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "geometry/frame.h"
#include "geometry/sampling.h"
#include "geometry/scene.h"
#include "gpu/core/context.h"

/// What `parity render --aa` chooses from.
namespace parity::tools {

/// How a picture gets its samples.
struct Antialiasing {
  enum class Kind { msaa, ssaa, accumulate, adaptive, automatic } kind = Kind::msaa;
  int samples = 1;  ///< msaa: 1, 2, 4, 8; ssaa: a square; accumulate: frames
  ReconstructionFilter filter = ReconstructionFilter::box;  ///< ssaa: what makes it small
  double max_error = 0;                                     ///< automatic: of the mean FLIP
};

/// "none", "msaa2|4|8", "ssaaN", "ssaaN:FILTER", "accumulateN", "adaptive", "auto".
///
/// @throws std::invalid_argument  something else.
Antialiasing parse_antialiasing(const std::string& text);

/// "msaa4".
std::string name_of(const Antialiasing& mode);

/// A way that was tried on a picture.
struct AntialiasingTrial {
  std::string mode;
  double error = 0;  ///< mean FLIP against 64 frames
  double seconds = 0;
};

struct Antialiased {
  Picture picture;
  std::string mode;                       ///< what made it
  std::vector<AntialiasingTrial> trials;  ///< of automatic
  bool meets = true;                      ///< automatic: the error is met
};

/// How the picture will be seen, for modes that look at what a screen shows.
struct Screen {
  double exposure = 0;  ///< stops
  /// What of it is shown: linear, 0 to 1, opaque. None: the colours times 2^exposure.
  std::function<Grid<vec4>(const Picture&)> shown = {};
};

/// Renders a frame anew; its sample count gives way to the mode.
///
/// @param frame  of the scene.
/// @throws std::invalid_argument  a picture too large for ssaa.
Antialiased render_antialiased(gpu::Context& context, const Scene& scene, const Frame& frame,
                               const Antialiasing& mode, const Screen& screen = {});

/// The same by the reference.
///
/// @throws std::invalid_argument  also: adaptive and automatic, which it does not do.
Antialiased render_antialiased(const Scene& scene, const Frame& frame, const Antialiasing& mode);

}  // namespace parity::tools
