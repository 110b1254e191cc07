#include "gpu/fluid/tiles.h"

#include "shaders.h"

namespace parity::gpu {

ActiveTiles::ActiveTiles(Context& context, const FluidBuffers& buffers, const FluidProblem& problem)
    : buffers_(buffers),
      is_liquid_(is_liquid(problem.parameters.method)),
      held_(context, source_rows(problem)),
      busy_(context, std::vector<std::uint32_t>(held_.count(), 0)),
      busy_kernel_(context, shaders::fluid_tile_busy_comp),
      flags_kernel_(context, shaders::fluid_tile_flags_comp),
      clear_kernel_(context, shaders::fluid_tile_clear_comp, {buffers.tiled()}) {}

void ActiveTiles::record_choice(Commands& commands, BufferRef<float> smoke,
                                BufferRef<float> temperature, BufferRef<std::uint32_t> ranges) {
  const FluidTileArgs args{.scene = buffers_.scene,
                           .clock = buffers_.clock,
                           .velocity = buffers_.velocity,
                           .smoke = smoke,
                           .temperature = temperature,
                           .ranges = ranges,
                           .held = held_,
                           .busy = busy_,
                           .is_liquid = is_liquid_ ? 1u : 0u,
                           .padding = 0};
  TileLists& tiles = *buffers_.tiles;
  if (is_liquid_) {
    commands.dispatch(busy_kernel_, {4 * tiles.tile_count()}, args);
  } else {
    tiles.dispatch(commands, busy_kernel_, tile_rows, args);
  }
  commands.dispatch(flags_kernel_, {tiles.tile_count()}, args);
  tiles.record(commands, {buffers_.clock.ref().address});
}

void ActiveTiles::record_clear_faces(Commands& commands) {
  FluidArgs args{.scene = buffers_.scene,
                 .clock = buffers_.clock,
                 .velocity = buffers_.velocity,
                 .other = buffers_.other,
                 .result = buffers_.third,
                 .field = {},
                 .field_result = {},
                 .axis = 0,
                 .mode = 0,
                 .weight = 0};
  for (args.axis = 0; args.axis < 3; ++args.axis)
    buffers_.tiles->dispatch(commands, clear_kernel_, left_faces, args);
}

void ActiveTiles::record_clear(Commands& commands, BufferRef<float> field, std::uint32_t numbers) {
  buffers_.tiles->dispatch(commands, clear_kernel_, left_cells,
                           FluidArgs{.scene = buffers_.scene,
                                     .clock = buffers_.clock,
                                     .velocity = buffers_.velocity,
                                     .other = buffers_.other,
                                     .result = buffers_.third,
                                     .field = field,
                                     .field_result = {},
                                     .axis = 3,
                                     .mode = numbers,
                                     .weight = 0});
}

std::vector<std::uint8_t> ActiveTiles::read_active() const {
  const std::vector<std::uint32_t> flags = buffers_.tiles->flags().read();
  const uvec3 tiles = buffers_.tiles->tiles(), cells(buffers_.cells);
  std::vector<std::uint8_t> active;
  for (std::uint32_t z = 0; z < cells.z; ++z)
    for (std::uint32_t y = 0; y < cells.y; ++y)
      for (std::uint32_t x = 0; x < cells.x; ++x) {
        const std::size_t tile =
            (std::size_t(z / tile_yz) * tiles.y + y / tile_yz) * tiles.x + x / tile_x;
        active.push_back((flags[tile] & tile_active) != 0 ? 1 : 0);
      }
  return active;
}

}  // namespace parity::gpu
