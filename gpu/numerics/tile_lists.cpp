#include "gpu/numerics/tile_lists.h"

#include "shaders.h"

namespace parity::gpu {

TileLists::TileLists(Context& context, uvec3 cells)
    : tiles_((cells + uvec3(tile_x, tile_yz, tile_yz) - 1u) / uvec3(tile_x, tile_yz, tile_yz)),
      is_flat_(cells.z == 1),
      flags_(context, tile_count()),
      list_(context, 5 * tile_count()),
      groups_(context, group_numbers),
      starts_(context, 257),
      table_(context, std::vector<TileTable>{{flags_, list_, groups_, starts_, 0, tile_count()}}),
      list_kernel_(context, shaders::numerics_tile_list_comp) {
  activate_all(context);
}

void TileLists::activate_all(Context& context) {
  flags_.write(std::vector<std::uint32_t>(tile_count(), tile_active));
  const Buffer<float> running(context, std::vector<float>{1});
  context.run([&](Commands& commands) { record(commands, running); });
}

void TileLists::visit_all() {
  table_.write(std::vector<TileTable>{{flags_, list_, groups_, starts_, 1, tile_count()}});
}

void TileLists::record(Commands& commands, BufferRef<float> clock) {
  commands.dispatch(
      list_kernel_, {256},
      {.table = table_, .clock = clock, .tiles = tiles_, .is_flat = is_flat_ ? 1u : 0u});
}

}  // namespace parity::gpu
