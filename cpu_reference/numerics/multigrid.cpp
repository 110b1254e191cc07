#include "cpu_reference/numerics/multigrid.h"

#include <algorithm>
#include <map>

#include "cpu_reference/numerics/pressure_matrix.h"

namespace parity::cpu {
namespace {

/// One grid: rows of a matrix, and which row of the next grid each belongs to.
struct Level {
  std::vector<double> diagonal;
  std::vector<std::vector<Link>> links;
  std::vector<std::uint32_t> parent;
  std::size_t coarse_size = 0;
};

using Vector = std::vector<double>;

double off_diagonal(const Level& level, std::size_t row, const Vector& x) {
  double sum = 0;
  for (const Link& link : level.links[row]) sum += link.value * x[link.column];
  return sum;
}

void relax_row(const Level& level, std::size_t row, const Vector& b, Vector& x) {
  if (level.diagonal[row] > 0)
    x[row] = (b[row] + off_diagonal(level, row, x)) / level.diagonal[row];
}

void relax_forth_and_back(const Level& level, const Vector& b, Vector& x) {
  for (std::size_t row = 0; row < x.size(); ++row) relax_row(level, row, b, x);
  for (std::size_t row = x.size(); row-- > 0;) relax_row(level, row, b, x);
}

Level finest_level(const PressureMatrix& a) {
  Level level;
  level.diagonal = a.diagonal;
  for (std::size_t row = 0; row < a.size(); ++row)
    level.links.emplace_back(a.links.begin() + std::ptrdiff_t(a.begin[row]),
                             a.links.begin() + std::ptrdiff_t(a.begin[row + 1]));
  return level;
}

/// Numbers the blocks that hold rows, and sets the parents of the rows.
std::vector<ivec3> block_rows(Level& level, const std::vector<ivec3>& places, ivec3 cells) {
  std::map<std::size_t, std::uint32_t> row_of_block;
  std::vector<ivec3> blocks;
  const Field index((cells + 1) / 2);
  for (const ivec3 place : places) {
    const ivec3 block = place / 2;
    const auto [entry, is_new] = row_of_block.try_emplace(index.index(block.x, block.y, block.z),
                                                          std::uint32_t(blocks.size()));
    if (is_new) blocks.push_back(block);
    level.parent.push_back(entry->second);
  }
  level.coarse_size = blocks.size();
  return blocks;
}

/// Sums of the fine equations over blocks; what links two cells of one block cancels.
Level galerkin(const Level& fine) {
  Level coarse;
  coarse.diagonal.assign(fine.coarse_size, 0.0);
  std::vector<std::map<std::uint32_t, double>> sums(fine.coarse_size);
  for (std::size_t row = 0; row < fine.diagonal.size(); ++row) {
    const std::uint32_t parent = fine.parent[row];
    coarse.diagonal[parent] += fine.diagonal[row];
    for (const Link& link : fine.links[row]) {
      const std::uint32_t other = fine.parent[link.column];
      if (other == parent) {
        coarse.diagonal[parent] -= link.value;
      } else {
        sums[parent][other] += link.value;
      }
    }
  }
  for (const auto& sum : sums) {
    coarse.links.emplace_back();
    for (const auto& [column, value] : sum) coarse.links.back().push_back({column, value});
  }
  return coarse;
}

std::vector<Level> hierarchy(const PressureMatrix& a, const PressureProblem& problem) {
  std::vector<Level> levels{finest_level(a)};
  std::vector<ivec3> places;
  ivec3 cells = problem.cells;
  for (int z = 0; z < cells.z; ++z)
    for (int y = 0; y < cells.y; ++y)
      for (int x = 0; x < cells.x; ++x)
        if (problem.types[problem.rhs.index(x, y, z)] == CellType::fluid)
          places.push_back({x, y, z});
  while (levels.back().diagonal.size() > 16) {
    places = block_rows(levels.back(), places, cells);
    cells = (cells + 1) / 2;
    levels.push_back(galerkin(levels.back()));
    if (levels.back().diagonal.size() == levels[levels.size() - 2].diagonal.size()) break;
  }
  return levels;
}

void cycle(const std::vector<Level>& levels, std::size_t at, const Vector& b, Vector& x) {
  const Level& level = levels[at];
  if (at + 1 == levels.size()) {
    for (int sweep = 0; sweep < 20; ++sweep) relax_forth_and_back(level, b, x);
    return;
  }
  relax_forth_and_back(level, b, x);
  Vector coarse_b(level.coarse_size, 0.0);
  for (std::size_t row = 0; row < x.size(); ++row)
    coarse_b[level.parent[row]] +=
        b[row] - (level.diagonal[row] * x[row] - off_diagonal(level, row, x));
  Vector correction(level.coarse_size, 0.0);
  cycle(levels, at + 1, coarse_b, correction);
  cycle(levels, at + 1, coarse_b, correction);
  constexpr double overcorrection = 1.8;
  for (std::size_t row = 0; row < x.size(); ++row)
    x[row] += overcorrection * correction[level.parent[row]];
  relax_forth_and_back(level, b, x);
}

}  // namespace

PressureAnswer multigrid(const PressureProblem& problem) {
  const PressureMatrix a(problem);
  const std::vector<Level> levels = hierarchy(a, problem);
  const Vector b = a.gather(problem.rhs);
  Vector x = a.gather(problem.guess);
  PressureAnswer answer;
  for (;;) {
    answer.residual = largest(a.residual(x, b));
    answer.converged = answer.residual <= problem.tolerance;
    if (answer.converged || answer.iterations >= problem.max_iterations) break;
    cycle(levels, 0, b, x);
    ++answer.iterations;
  }
  answer.pressure = a.scatter(x);
  return answer;
}

}  // namespace parity::cpu
