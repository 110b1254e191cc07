#pragma once

#include "tools/sim_run.h"

/// The simulators behind start_simulation.
namespace parity::tools {

Simulation start_sph_on_device(const SimScene& scene, gpu::Context& context);
Simulation start_sph_on_host(const SimScene& scene);
Simulation start_grid_on_device(const SimScene& scene, gpu::Context& context);
Simulation start_grid_on_host(const SimScene& scene);

}  // namespace parity::tools
