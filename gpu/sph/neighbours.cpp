#include "gpu/sph/neighbours.h"

#include <algorithm>
#include <bit>
#include <string>

#include "gpu/core/error.h"
#include "gpu/sph/constants.h"
#include "shaders.h"

namespace parity::gpu {
namespace {

const SphGrid& grid_of(const SphConstants& constants, bool walls) {
  return walls ? constants.wall_grid : constants.grid;
}

std::uint32_t cell_count(const SphGrid& grid) { return grid.cells.x * grid.cells.y * grid.cells.z; }

/// A bit for each cell whose box a point is within the support of, and a thousandth against
/// rounding; cells at the rim go on outwards without end.
std::vector<std::uint32_t> cells_near(const SphGrid& grid, const std::vector<vec3>& points) {
  const uvec3 n = grid.cells;
  const vec3 last = vec3(n) - 1.0f;
  std::vector<std::uint32_t> bits((std::size_t(n.x) * n.y * n.z + 31) / 32);
  for (const vec3& point : points) {
    const vec3 at = glm::clamp((point - grid.low) * grid.inverse_cell, vec3(0), vec3(n));
    const vec3 first = glm::clamp(glm::floor(at - 2.01f), vec3(0), last);
    const vec3 end = glm::clamp(glm::floor(at + 2.01f), vec3(0), last);
    vec3 cell;
    for (cell.z = first.z; cell.z <= end.z; ++cell.z)
      for (cell.y = first.y; cell.y <= end.y; ++cell.y)
        for (cell.x = first.x; cell.x <= end.x; ++cell.x) {
          const vec3 apart = at - glm::clamp(at, cell, cell + 1.0f);
          if (glm::dot(apart, apart) > 4.02f) continue;
          const std::size_t index =
              (std::size_t(cell.z) * n.y + std::size_t(cell.y)) * n.x + std::size_t(cell.x);
          bits[index / 32] |= 1u << index % 32;
        }
  }
  return bits;
}

/// Of a particle's list: blocks of 64 particles.
std::size_t list_first(const SphConstants& constants, std::uint32_t i) {
  return std::size_t(i / 64 * 64) * (constants.capacity + 1) + i % 64;
}

std::vector<Specialization> kernel_of(std::uint32_t kernel) { return {{0, kernel}}; }

}  // namespace

std::vector<vec4> with_zero(const std::vector<vec3>& points) {
  std::vector<vec4> result;
  result.reserve(points.size());
  for (const vec3& point : points) result.emplace_back(point, 0.0f);
  return result;
}

CellSort::CellSort(Context& context, const SphConstants& constants, std::uint32_t count, bool walls)
    : count_(count),
      walls_(walls ? 1 : 0),
      cell_count_(cell_count(grid_of(constants, walls))),
      row_(grid_of(constants, walls).cells.x),
      rows_(grid_of(constants, walls).cells.y),
      key_bits_(std::uint32_t(std::bit_width(cell_count_))),
      cell_key_(context, shaders::sph_cell_key_comp),
      cell_start_(context, shaders::sph_cell_start_comp),
      gather_(context, shaders::sph_gather_comp),
      sort_(context, count),
      count_buffer_(context, std::vector<std::uint32_t>{count}),
      keys_(context, count),
      ids_(context, count),
      starts_(context, cell_count_ + 1),
      sorted_(context, count) {}

void CellSort::record(Commands& commands, BufferRef<SphConstants> constants,
                      BufferRef<vec4> positions) {
  if (count_ > 0) {
    commands.dispatch(cell_key_, {count_},
                      {.constants = constants,
                       .positions = positions,
                       .keys = keys_,
                       .ids = ids_,
                       .count = count_,
                       .walls = walls_});
    sort_.record(commands, count_buffer_, keys_, ids_, key_bits_);
  }
  CellStartArgs args{.keys = keys_,
                     .starts = starts_,
                     .count = count_,
                     .cell_count = cell_count_,
                     .row = row_,
                     .rows = 0};
  commands.dispatch(cell_start_, {cell_count_ / row_ + 1}, args);
  args.rows = rows_;
  commands.dispatch(cell_start_, {row_, rows_, cell_count_ / (row_ * rows_)}, args);
  record_gather(commands, positions, sorted_);
}

void CellSort::record_gather(Commands& commands, BufferRef<vec4> from, BufferRef<vec4> to) const {
  if (count_ > 0)
    commands.dispatch(gather_, {count_}, {.ids = ids_, .from = from, .to = to, .count = count_});
}

Neighbours::Neighbours(Context& context, const SphProblem& problem, const SphConstants& constants)
    : count_(constants.count),
      constants_(context, std::vector<SphConstants>{constants}),
      cells_(context, constants, constants.count, false),
      boundary_cells_(context, constants, constants.boundary_count, true),
      neighbours_(context, shaders::sph_neighbours_comp,
                  kernel_of(std::uint32_t(problem.parameters.kernel))),
      boundary_(context, constants.boundary_count),
      boundary_motions_(context, constants.boundary_count),
      lists_(context, list_first(constants, (constants.count + 63) / 64 * 64)),
      counts_(context, constants.count),
      densities_(context, constants.count),
      near_walls_(context, cells_near(constants.grid, problem.boundary)) {
  weigh_boundary(context, problem);
}

void Neighbours::weigh_boundary(Context& context, const SphProblem& problem) {
  const auto count = std::uint32_t(problem.boundary.size());
  if (count == 0) return;
  const auto kernel = std::uint32_t(problem.parameters.kernel);
  const Kernel<BoundaryVolumeArgs> weigh(context, shaders::sph_boundary_volume_comp,
                                         kernel_of(kernel));
  const Buffer<vec4> positions(context, with_zero(problem.boundary));
  const Buffer<vec4> motions(context, problem.boundary_motions.empty()
                                          ? std::vector<vec4>(count, vec4(0, 0, 0, 1))
                                          : problem.boundary_motions);
  context.run([&](Commands& commands) {
    boundary_cells_.record(commands, constants_, positions);
    boundary_cells_.record_gather(commands, motions, boundary_motions_);
    commands.dispatch(weigh, {count},
                      {.constants = constants_,
                       .boundary = boundary_cells_.sorted(),
                       .starts = boundary_cells_.starts(),
                       .weighted = boundary_,
                       .count = count});
  });
}

void Neighbours::record(Commands& commands, BufferRef<vec4> positions) {
  if (count_ == 0) return;
  commands.pass("sort");
  cells_.record(commands, constants_, positions);
  commands.pass("neighbours");
  commands.dispatch(neighbours_, {count_},
                    {.constants = constants_,
                     .positions = cells_.sorted(),
                     .starts = cells_.starts(),
                     .boundary = boundary_,
                     .boundary_starts = boundary_cells_.starts(),
                     .near_walls = near_walls_,
                     .lists = lists_,
                     .counts = counts_,
                     .densities = densities_,
                     .count = count_});
}

SphNeighbourLists sph_neighbours(Context& context, const SphProblem& problem) {
  const SphConstants constants = sph_constants(problem);
  Neighbours neighbours(context, problem, constants);
  const Buffer<vec4> positions(context, with_zero(problem.initial.positions));
  context.run([&](Commands& commands) { neighbours.record(commands, positions); });
  const std::vector<std::uint32_t> ids = neighbours.cells().ids().read();
  const std::vector<std::uint32_t> wall_ids = neighbours.boundary_cells().ids().read();
  const std::vector<std::uint32_t> lists = neighbours.lists().read();
  const std::vector<uvec2> counts = neighbours.counts().read();
  const std::size_t n = ids.size();
  SphNeighbourLists result{std::vector<std::vector<std::uint32_t>>(n),
                           std::vector<std::vector<std::uint32_t>>(n)};
  for (std::size_t i = 0; i < n; ++i) {
    if (counts[i].y > constants.capacity)
      throw Error(ErrorKind::other, "sph_neighbours: particle " + std::to_string(ids[i]) + " has " +
                                        std::to_string(counts[i].y) +
                                        " neighbours, the lists hold " +
                                        std::to_string(constants.capacity));
    const std::size_t first = list_first(constants, std::uint32_t(i));
    for (std::uint32_t k = 0; k < counts[i].y; ++k) {
      const std::uint32_t j = lists[first + 64 * std::size_t(k)];
      if (k < counts[i].x)
        result.fluid[ids[i]].push_back(ids[j]);
      else
        result.walls[ids[i]].push_back(wall_ids[j]);
    }
    std::ranges::sort(result.fluid[ids[i]]);
    std::ranges::sort(result.walls[ids[i]]);
  }
  return result;
}

}  // namespace parity::gpu
