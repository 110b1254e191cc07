#include "tools/sim_run.h"

#include <stdexcept>
#include <string>

#include "tools/sim_run_methods.h"

namespace parity::tools {

Simulation start_simulation(const SimScene& scene, gpu::Context* context) {
  if (!is_sph(scene.method))
    throw std::invalid_argument(std::string("method: ") + name_of(scene.method) +
                                " has no simulator");
  return context != nullptr ? start_sph_on_device(scene, *context) : start_sph_on_host(scene);
}

}  // namespace parity::tools
