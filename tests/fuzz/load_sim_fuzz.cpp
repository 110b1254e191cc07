#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "geometry/input_error.h"
#include "sim/scene_io.h"

/// Whatever the bytes, a scene of a simulation is refused by InputError or holds what its contract
/// says: nothing at fault, counts within what may be asked for, and the same text of its physics
/// every time.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const parity::SimScene scene = parity::decode_sim_scene(text, "fuzz.json");
    const glm::ivec3 cells = parity::cells_of(scene);
    const double count = double(cells.x) * cells.y * cells.z;
    // Rounding each side to whole cells may add half of one.
    if (!parity::scene_fault(scene).empty() || !(count <= 4 * parity::max_sim_cells)) std::abort();
    if (parity::frame_count(scene) < 0 || parity::frame_count(scene) > parity::max_sim_frames + 1)
      std::abort();
    if (parity::physics_text(scene) !=
        parity::physics_text(parity::decode_sim_scene(text, "fuzz.json")))
      std::abort();
  } catch (const parity::InputError&) {
  }
  return 0;
}
