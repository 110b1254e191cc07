#include "gpu/numerics/pressure_system.h"

#include <algorithm>
#include <cmath>

#include "shaders.h"

namespace parity::gpu {
namespace {

/// Cells along z that one thread takes: long where threads are few.
std::uint32_t run_length(const Context& context, const PressureShape& shape) {
  const std::uint32_t longest = context.info().type == "cpu" ? 16 : 4;
  return std::min(longest, std::max(1u, shape.cells.z / 2));
}

std::uint32_t quads_in_row(std::uint32_t cells) { return (cells + 7) / 8; }

std::size_t quads_of(uvec3 cells) {
  return std::size_t{2} * quads_in_row(cells.x) * cells.y * cells.z;
}

bool is_periodic(const PressureShape& shape, int axis) {
  return (shape.flags & (pressure_periodic << axis)) != 0;
}

/// Half as many cells along each axis. None: too small, or odd along a periodic axis.
bool coarsened(const PressureShape& shape, uvec3 cells, uvec3& coarse) {
  if (std::max({cells.x, cells.y, cells.z}) <= 2 || cells.x == 1) return false;
  for (int axis = 0; axis < 3; ++axis) {
    if (is_periodic(shape, axis) && cells[axis] > 1 && cells[axis] % 4 != 0) return false;
    coarse[axis] = (cells[axis] + 1) / 2;
  }
  return true;
}

/// A cell of level l is 2^l wide; its middle lies (2^l + 1) / 2 from where the pressure is 0.
float open_weight(std::size_t level) {
  const double width = std::ldexp(1.0, int(level));
  return float(2 * width / (width + 1));
}

std::uint32_t thread_count(const PressureLevel& level, std::uint32_t run) {
  return level.row * level.cells.y * ((level.cells.z + run - 1) / run);
}

template <typename T>
void fill_with_zero(Context& context, const std::vector<Buffer<T>>& buffers) {
  context.run([&](Commands& commands) {
    for (const Buffer<T>& buffer : buffers) commands.fill(buffer, 0);
  });
}

}  // namespace

PressureShape shape_of(const FluidDomain& domain, bool with_words) {
  PressureShape shape{.cells = uvec3(domain.cells), .flags = 0, .with_words = with_words};
  for (std::uint32_t side = 0; side < 6; ++side) {
    const WallKind kind = domain.walls[side].kind;
    if (kind == WallKind::open || kind == WallKind::periodic) shape.flags |= 1u << side;
    if (kind == WallKind::periodic) shape.flags |= pressure_periodic << (side / 2);
  }
  return shape;
}

PressureShape shape_of(const PressureProblem& problem) {
  PressureShape shape{.cells = uvec3(problem.cells)};
  bool inside_open = true;
  for (int axis = 0; axis < 3; ++axis) {
    const Field& open = problem.open[std::size_t(axis)];
    std::array<bool, 2> sides{true, true};
    for (int z = 0; z < open.size.z; ++z)
      for (int y = 0; y < open.size.y; ++y)
        for (int x = 0; x < open.size.x; ++x) {
          const int at = ivec3(x, y, z)[axis];
          const bool whole = open(x, y, z) == 1;
          if (at == 0) sides[0] = sides[0] && whole;
          if (at == problem.cells[axis]) sides[1] = sides[1] && whole;
          // A side is all open or all closed, or else the cells must say.
          const bool is_side = at == 0 || at == problem.cells[axis];
          inside_open = inside_open && (whole || (is_side && open(x, y, z) == 0));
        }
    for (std::uint32_t k = 0; k < 2; ++k)
      if (sides[k]) shape.flags |= 1u << (2 * std::uint32_t(axis) + k);
    if (problem.periodic[std::size_t(axis)]) shape.flags |= pressure_periodic << axis;
  }
  shape.with_words = !inside_open || std::ranges::any_of(problem.types, [](CellType type) {
    return type != CellType::fluid;
  });
  return shape;
}

PressureSystem::PressureSystem(Context& context, const PressureShape& shape, const TileLists* tiles)
    : shape_(shape),
      tiles_(tiles),
      run_(run_length(context, shape)),
      reduce_(context, shaders::numerics_reduce_comp, {{2, is_tiled()}}),
      pack_(context, shaders::numerics_pack_comp, {{2, is_tiled()}}),
      coarsen_(context, shaders::numerics_coarsen_comp) {
  uvec3 cells = shape.cells, coarse{0};
  for (bool more = true; more; cells = coarse) {
    pressures_.emplace_back(context, quads_of(cells));
    right_sides_.emplace_back(context, quads_of(cells));
    words_.emplace_back(context, shape.with_words ? quads_of(cells) : 0);
    levels_.push_back({.cells = cells,
                       .flags = shape.flags,
                       .pressure = pressures_.back(),
                       .rhs = right_sides_.back(),
                       .words = words_.back(),
                       .row = quads_in_row(cells.x),
                       .open_weight = open_weight(levels_.size())});
    more = coarsened(shape, cells, coarse);
  }
  control_ = Buffer<SolverControl>(context, 1);
  // Enough for a pass with runs of one cell, and for pairs of vector operations.
  partials_ = Buffer<float>(context, std::max<std::size_t>(quads_of(shape.cells), 1024));
  if (tiles_ != nullptr) partials_ = Buffer<float>(context, std::size_t{8} * tiles_->tile_count());
  fill_with_zero(context, words_);
  fill_with_zero(context, pressures_);
  fill_with_zero(context, right_sides_);
}

std::uint32_t PressureSystem::quad_count(std::size_t level) const {
  return std::uint32_t(quads_of(levels_[level].cells));
}

void PressureSystem::record_pack(Commands& commands, BufferRef<std::uint32_t> types,
                                 const std::array<BufferRef<float>, 3>& open, bool keep_tiles) {
  if (!shape_.with_words) return;
  const PackArgs args{.level = levels_[0],
                      .types = types,
                      .open_x = open[0],
                      .open_y = open[1],
                      .open_z = open[2],
                      .tiles = tile_table(),
                      .keep_tiles = keep_tiles ? 1u : 0u,
                      .padding = 0};
  if (tiles_ != nullptr) {
    tiles_->dispatch(commands, pack_, touched_cells, args);
  } else {
    commands.dispatch(pack_, {4 * quad_count()}, args);
  }
  for (std::size_t l = 1; l < levels_.size(); ++l)
    commands.dispatch(coarsen_, {4 * quad_count(l)},
                      {.fine = levels_[l - 1],
                       .coarse = levels_[l],
                       .control = control_,
                       .tiles = tile_table(),
                       .mode = keep_tiles && l == 1 ? 1u : 0u,
                       .padding = 0});
}

Kernel<SweepArgs> PressureSystem::make_sweep(Context& context, Sweep mode, bool is_finest) const {
  return Kernel<SweepArgs>(context, shaders::numerics_sweep_comp,
                           {{0, shape_.with_words ? 1u : 0u},
                            {1, std::uint32_t(mode)},
                            {2, is_finest ? is_tiled() : 0}});
}

void PressureSystem::record_sweep(Commands& commands, const Kernel<SweepArgs>& kernel,
                                  const PressureLevel& level, std::uint32_t colour, float omega,
                                  BufferRef<PressureQuad> result) {
  const SweepArgs args{.level = level,
                       .result = result,
                       .partials = partials_,
                       .control = control_,
                       .tiles = tile_table(),
                       .colour = colour,
                       .run = run_,
                       .omega = omega,
                       .padding = 0};
  if (tiles_ != nullptr && level.cells == finest().cells) {
    tiles_->dispatch(commands, kernel, tile_rows, args);
  } else {
    commands.dispatch(kernel, {thread_count(level, run_)}, args);
  }
}

std::uint32_t PressureSystem::sweep_partials() const { return thread_count(finest(), run_); }

void PressureSystem::record_reduce(Commands& commands, Reduction reduction, std::uint32_t count) {
  commands.dispatch(reduce_, {256},
                    {.partials = partials_,
                     .control = control_,
                     .tiles = tile_table(),
                     .count = tiles_ != nullptr ? tiles_->tile_count() : count,
                     .mode = std::uint32_t(reduction)});
}

std::vector<PressureQuad> PressureSystem::to_quads(const Field& field) const {
  std::vector<PressureQuad> quads(quad_count(), PressureQuad{vec4(0)});
  const uvec3 cells = shape_.cells;
  for (std::uint32_t z = 0; z < cells.z; ++z)
    for (std::uint32_t y = 0; y < cells.y; ++y)
      for (std::uint32_t x = 0; x < cells.x; ++x) {
        const std::uint32_t colour = (x + y + z) & 1;
        const std::size_t row = (std::size_t(colour * cells.z + z) * cells.y + y) * finest().row;
        quads[row + x / 8].cells[int(x / 2 % 4)] = float(field(int(x), int(y), int(z)));
      }
  return quads;
}

Field PressureSystem::to_field(const std::vector<PressureQuad>& quads) const {
  Field field{ivec3(shape_.cells)};
  const uvec3 cells = shape_.cells;
  for (std::uint32_t z = 0; z < cells.z; ++z)
    for (std::uint32_t y = 0; y < cells.y; ++y)
      for (std::uint32_t x = 0; x < cells.x; ++x) {
        const std::uint32_t colour = (x + y + z) & 1;
        const std::size_t row = (std::size_t(colour * cells.z + z) * cells.y + y) * finest().row;
        field(int(x), int(y), int(z)) = double(quads[row + x / 8].cells[int(x / 2 % 4)]);
      }
  return field;
}

void PressureSystem::upload(Context& context, const PressureProblem& problem) {
  pressures_[0].write(to_quads(problem.guess));
  if (shape_.with_words) {
    std::vector<std::uint32_t> types;
    for (const CellType type : problem.types) types.push_back(std::uint32_t(type));
    std::vector<Buffer<float>> open;
    for (const Field& field : problem.open)
      open.emplace_back(context, std::vector<float>(field.values.begin(), field.values.end()));
    const Buffer<std::uint32_t> type_buffer(context, types);
    context.run([&](Commands& commands) {
      record_pack(commands, type_buffer, {open[0].ref(), open[1].ref(), open[2].ref()}, false);
    });
  }
  right_sides_[0].write(to_quads(problem.rhs));
  SolverControl control{};
  control.tolerance = float(problem.tolerance);
  control_.write(std::vector<SolverControl>{control});
}

PressureAnswer PressureSystem::download() const {
  const SolverControl control = read_control();
  return {.pressure = to_field(pressures_[0].read()),
          .iterations = int(control.iterations),
          .residual = double(control.residual),
          .converged = control.done != 0};
}

}  // namespace parity::gpu
