#pragma once

#include <functional>
#include <optional>
#include <string>

#include "gpu/core/context.h"
#include "sim/scene.h"

namespace parity::tools {

/// A run of `parity sim`: what to write where.
struct SimJob {
  std::string input;
  std::string folder;
  std::string backend = "gpu";
  std::optional<ivec2> frames;  ///< first and last to write; none: all
  bool resume = false;
  bool video = false;
  bool quiet = false;
  bool verbose = false;
  bool json = false;
  double checkpoint_seconds = 20;
  std::function<bool()> is_interrupted;  ///< asked after every few steps
};

/// Steps from frame to frame, writes each, leaves a checkpoint now and then and at the end.
///
/// @param context  null: the CPU reference steps and draws.
/// @return  0; 1 the simulation failed (what is finished is kept); 130 interrupted.
/// @throws InputError  the checkpoint is missing, damaged or another scene's; OutputError a file
///                     cannot be written; std::invalid_argument the method cannot do the scene.
int run_sim_job(const SimJob& job, const SimScene& scene, gpu::Context* context);

}  // namespace parity::tools
