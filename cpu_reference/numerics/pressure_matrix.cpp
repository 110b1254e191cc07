#include "cpu_reference/numerics/pressure_matrix.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace parity::cpu {
namespace {

constexpr std::uint32_t no_row = std::numeric_limits<std::uint32_t>::max();

ivec3 coordinates(ivec3 cells, std::size_t index) {
  const auto nx = std::size_t(cells.x), ny = std::size_t(cells.y);
  return {int(index % nx), int(index / nx % ny), int(index / (nx * ny))};
}

}  // namespace

PressureMatrix::PressureMatrix(const PressureProblem& problem) : cells_(problem.cells) {
  std::vector<std::uint32_t> row_of_cell(problem.types.size(), no_row);
  for (std::size_t i = 0; i < problem.types.size(); ++i)
    if (problem.types[i] == CellType::fluid) {
      row_of_cell[i] = std::uint32_t(cell_of_row_.size());
      cell_of_row_.push_back(i);
    }
  const Field index(cells_);
  for (const std::size_t at : cell_of_row_) {
    const ivec3 cell = coordinates(cells_, at);
    begin.push_back(links.size());
    double sum = 0;
    for (int axis = 0; axis < 3; ++axis)
      for (const int side : {0, 1}) {
        const double open = problem.open[std::size_t(axis)](cell + side * axis_step(axis));
        sum += open;
        ivec3 other = cell;
        other[axis] += 2 * side - 1;
        if (problem.periodic[std::size_t(axis)])
          other[axis] = (other[axis] + cells_[axis]) % cells_[axis];
        if (open == 0 || other[axis] < 0 || other[axis] >= cells_[axis]) continue;
        const std::uint32_t row = row_of_cell[index.index(other.x, other.y, other.z)];
        if (row != no_row) links.push_back({row, open});
      }
    diagonal.push_back(sum);
  }
  begin.push_back(links.size());
}

std::vector<double> PressureMatrix::gather(const Field& field) const {
  std::vector<double> values;
  for (const std::size_t cell : cell_of_row_) values.push_back(field.values[cell]);
  return values;
}

Field PressureMatrix::scatter(const std::vector<double>& values) const {
  Field field(cells_);
  for (std::size_t row = 0; row < values.size(); ++row)
    field.values[cell_of_row_[row]] = values[row];
  return field;
}

double PressureMatrix::neighbours(std::size_t row, const std::vector<double>& x) const {
  double sum = 0;
  for (std::size_t k = begin[row]; k < begin[row + 1]; ++k)
    sum += links[k].value * x[links[k].column];
  return sum;
}

std::vector<double> PressureMatrix::times(const std::vector<double>& x) const {
  std::vector<double> result(x.size());
  for (std::size_t row = 0; row < x.size(); ++row)
    result[row] = diagonal[row] * x[row] - neighbours(row, x);
  return result;
}

std::vector<double> PressureMatrix::residual(const std::vector<double>& x,
                                             const std::vector<double>& b) const {
  std::vector<double> result = times(x);
  for (std::size_t row = 0; row < x.size(); ++row) result[row] = b[row] - result[row];
  return result;
}

double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

}  // namespace parity::cpu
