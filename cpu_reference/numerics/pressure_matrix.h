#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sim/pressure.h"

namespace parity::cpu {

/// One coefficient of a row: -value is the matrix entry in that column.
struct Link {
  std::uint32_t column = 0;
  double value = 0;
};

/// The pressure system as a sparse matrix over the fluid cells, numbered x fastest.
class PressureMatrix {
 public:
  explicit PressureMatrix(const PressureProblem& problem);

  std::size_t size() const { return diagonal.size(); }
  /// Entries of row i below or right of the diagonal are links[begin[i]] to links[begin[i + 1] -
  /// 1].
  std::vector<double> diagonal;
  std::vector<std::size_t> begin;
  std::vector<Link> links;

  std::vector<double> gather(const Field& field) const;  ///< values of the fluid cells
  Field scatter(const std::vector<double>& values) const;
  std::vector<double> times(const std::vector<double>& x) const;
  /// b - A x.
  std::vector<double> residual(const std::vector<double>& x, const std::vector<double>& b) const;
  /// Sum of links times x of a row.
  double neighbours(std::size_t row, const std::vector<double>& x) const;

 private:
  ivec3 cells_;
  std::vector<std::size_t> cell_of_row_;
};

double largest(const std::vector<double>& values);

}  // namespace parity::cpu
