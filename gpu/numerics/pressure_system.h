#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gpu/core/buffer.h"
#include "gpu/core/commands.h"
#include "gpu/core/kernel.h"
#include "gpu/numerics/tile_lists.h"
#include "shaders/numerics/layout.h"
#include "sim/pressure.h"

namespace parity::gpu {

/// What one pass over a grid does: the modes of numerics/sweep.comp.
enum class Sweep : std::uint32_t { smooth_colour, first_colour, jacobi, residual, apply, measure };

/// What a reduction makes of its number: the modes of numerics/reduce.comp.
enum class Reduction : std::uint32_t {
  largest_residual,
  next_direction,
  step_length,
  mean,
  cycle_residual
};

/// What makes a system: its size, which sides are open or periodic (bits as in
/// PressureLevel::flags) and whether its cells differ (solids, air, partly open faces) or fill a
/// box.
struct PressureShape {
  uvec3 cells{0};
  std::uint32_t flags = 0;
  bool with_words = false;
};
PressureShape shape_of(const PressureProblem& problem);
/// The same for a simulation's domain; `with_words` where solids or air may come.
PressureShape shape_of(const FluidDomain& domain, bool with_words);

/// A pressure system on the device: a hierarchy of grids, each half as fine as the one before, and
/// the commands that all solvers are made of. Memory: 8 bytes a cell of the finest grid and 4 more
/// with words, a seventh on top for the coarse grids, rows padded to 8 cells.
///
/// Mathematics: sim/pressure.h. Layout: shaders/numerics/layout.h.
class PressureSystem {
 public:
  /// @param tiles  of the finest grid, all others are visited whole; null: the whole box. Cells of
  ///               other tiles are air and keep a pressure of 0. Needs words.
  PressureSystem(Context& context, const PressureShape& shape, const TileLists* tiles = nullptr);

  const PressureShape& shape() const { return shape_; }
  const std::vector<PressureLevel>& levels() const { return levels_; }
  const PressureLevel& finest() const { return levels_.front(); }
  std::uint32_t quad_count(std::size_t level = 0) const;
  const Buffer<PressureQuad>& pressure() const { return pressures_.front(); }
  const Buffer<PressureQuad>& rhs() const { return right_sides_.front(); }
  const Buffer<SolverControl>& control() const { return control_; }
  const Buffer<float>& partials() const { return partials_; }
  std::uint32_t run() const { return run_; }
  const TileLists* tiles() const { return tiles_; }
  /// Null but for the finest grid.
  const TileLists* tiles(std::size_t level) const { return level == 0 ? tiles_ : nullptr; }
  BufferRef<TileTable> tile_table() const {
    return tiles_ != nullptr ? tiles_->table() : BufferRef<TileTable>{};
  }

  /// Words of all grids; cells that are not fluid lose their pressure. Arrays are those of
  /// sim/pressure.h in float.
  ///
  /// @param keep_tiles  tiles that are active, or not, as at the last call keep their words.
  void record_pack(Commands& commands, BufferRef<std::uint32_t> types,
                   const std::array<BufferRef<float>, 3>& open, bool keep_tiles);

  /// One pass over a grid. `result` where the mode has one.
  void record_sweep(Commands& commands, const Kernel<SweepArgs>& kernel, const PressureLevel& level,
                    std::uint32_t colour, float omega, BufferRef<PressureQuad> result = {});
  /// Partials that a pass over the finest grid leaves.
  std::uint32_t sweep_partials() const;
  void record_reduce(Commands& commands, Reduction reduction, std::uint32_t count);

  /// For the finest grid, or the others.
  Kernel<SweepArgs> make_sweep(Context& context, Sweep mode, bool is_finest = true) const;

  /// Host arrays: a field of cells, x fastest, to and from colours.
  std::vector<PressureQuad> to_quads(const Field& field) const;
  Field to_field(const std::vector<PressureQuad>& quads) const;

  /// Puts a problem in: words, right side and guess, and the control of a new solve.
  void upload(Context& context, const PressureProblem& problem);
  void write_pressure(const Field& pressure) { pressures_[0].write(to_quads(pressure)); }
  PressureAnswer download() const;
  /// The control as it stands.
  SolverControl read_control() const { return control_.read().front(); }

 private:
  std::uint32_t is_tiled() const { return tiles_ != nullptr ? 1 : 0; }

  PressureShape shape_;
  const TileLists* tiles_;
  std::uint32_t run_;
  std::vector<Buffer<PressureQuad>> pressures_, right_sides_;
  std::vector<Buffer<PressureWords>> words_;
  std::vector<PressureLevel> levels_;
  Buffer<SolverControl> control_;
  Buffer<float> partials_;
  Kernel<ReduceArgs> reduce_;
  Kernel<PackArgs> pack_;
  Kernel<TransferArgs> coarsen_;
};

}  // namespace parity::gpu
