// SPDX-License-Identifier: Apache-2.0
// Gauss's elimination with complete pivoting, in doubles, on room that is allocated once: which equations to
// solve for which unknowns, by how much, and the inverse that preconditions an interval Newton step.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hcsp::online {

class Pivoting {
 public:
  Pivoting(std::size_t most_rows, std::size_t most_columns);

  /// Starts a matrix of so many rows and columns, all 0. PRECONDITION: at most as many as there is room for.
  void start(std::size_t rows, std::size_t columns);
  double& at(std::size_t row, std::size_t column) { return matrix_[row * columns_ + column]; }
  double& right(std::size_t row) { return right_[row]; }

  /// Eliminates as long as there are pivots above `noise`; false where a number is not finite. Rows are
  /// scaled to their greatest entry first.
  bool eliminate(double noise);
  /// After eliminate(), other right sides: the same pivots. All of them are to be given.
  void solve_again();
  /// How many rows and columns were pivoted on, and which.
  [[nodiscard]] std::size_t rank() const { return rank_; }
  [[nodiscard]] std::uint32_t row(std::size_t k) const { return row_of_[k]; }
  [[nodiscard]] std::uint32_t column(std::size_t k) const { return column_of_[k]; }
  /// The solution of the pivoted rows in the pivoted columns, by pivot.
  [[nodiscard]] double solution(std::size_t k) const { return solution_[k]; }

 private:
  bool scale_rows();
  bool find_pivot(std::size_t k, double noise);
  void substitute_back();

  std::size_t columns_ = 0, rows_ = 0, rank_ = 0;
  std::vector<double> matrix_, right_, solution_;  // below the pivots, the factors that eliminated
  std::vector<double> scales_;                     // by row
  std::vector<std::uint32_t> row_of_, column_of_;  // the first rank() are pivots
};

/// The inverse of a square matrix, row after row, by Gauss-Jordan with partial pivoting; false where it is
/// singular. `matrix` is used up.
bool invert(std::span<double> matrix, std::span<double> inverse, std::size_t size);

}  // namespace hcsp::online
