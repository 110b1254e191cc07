#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/environment.h"
#include "geometry/frame.h"
#include "geometry/scene.h"
#include "tools/antialias.h"
#include "tools/render_options.h"

/// One picture of `parity render`, on either side.
namespace parity::tools {

/// A picture of the light from all around.
struct Surroundings {
  EnvironmentMap light;
  EnvironmentMap backdrop;
};

/// None unless the text names a file.
std::optional<Surroundings> load_environment(const std::string& text, bool is_shown);

/// What is drawn.
struct Task {
  const RenderArguments& arguments;
  const Scene& scene;
  Frame frame;
  std::optional<Surroundings> environment;
  bool display = false;  ///< 8-bit output

  bool casts_shadows() const { return arguments.shadows == "on"; }
  bool occludes() const { return arguments.ambient_occlusion == "on"; }
  bool shows_environment() const { return environment && arguments.background.empty(); }
};

/// What came of it.
struct Job {
  Picture picture;
  Grid<u8vec4> display;  ///< filled for 8-bit output
  std::string aa;        ///< what --aa made it with; empty: not asked
  std::vector<AntialiasingTrial> trials;
  bool meets = true;  ///< the error that --aa auto was given
  std::string device;
  double seconds = 0;
};

/// Prepares the light (environment, shadows, occlusion), draws, and finishes what is shown.
///
/// @param task  of which the frame's light is completed.
Job render_on_cpu(Task& task);
Job render_on_gpu(Task& task);

/// A colour over nothing is stored premultiplied; files hold straight colour.
Grid<vec4> straight_alpha(Grid<vec4> color);

double seconds_now();

}  // namespace parity::tools
