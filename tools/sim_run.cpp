#include "tools/sim_run.h"

#include "tools/sim_run_methods.h"

namespace parity::tools {

Simulation start_simulation(const SimScene& scene, gpu::Context* context) {
  if (is_sph(scene.method))
    return context != nullptr ? start_sph_on_device(scene, *context) : start_sph_on_host(scene);
  return context != nullptr ? start_grid_on_device(scene, *context) : start_grid_on_host(scene);
}

}  // namespace parity::tools
