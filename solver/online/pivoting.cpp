// SPDX-License-Identifier: Apache-2.0
#include "solver/online/pivoting.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hcsp::online {

Pivoting::Pivoting(std::size_t most_rows, std::size_t most_columns)
    : matrix_(most_rows * most_columns),
      right_(most_rows),
      solution_(most_rows),
      scales_(most_rows),
      row_of_(most_rows),
      column_of_(most_columns) {}

void Pivoting::start(std::size_t rows, std::size_t columns) {
  rows_ = rows;
  columns_ = columns;
  std::fill_n(matrix_.begin(), rows * columns_, 0.0);
}

bool Pivoting::scale_rows() {
  for (std::size_t i = 0; i < rows_; ++i) {
    double most = 0.0;
    for (std::size_t j = 0; j < columns_; ++j) {
      if (!std::isfinite(at(i, j))) return false;
      most = std::max(most, std::abs(at(i, j)));
    }
    if (!std::isfinite(right_[i])) return false;
    scales_[i] = most == 0.0 ? 1.0 : most;
    for (std::size_t j = 0; j < columns_; ++j) at(i, j) /= scales_[i];
    right_[i] /= scales_[i];
  }
  return true;
}

bool Pivoting::find_pivot(std::size_t k, double noise) {
  double most = noise;
  std::size_t best_row = rows_, best_column = columns_;
  for (std::size_t i = k; i < rows_; ++i) {
    for (std::size_t j = k; j < columns_; ++j) {
      const double size = std::abs(at(row_of_[i], column_of_[j]));
      if (size > most) {
        most = size;
        best_row = i;
        best_column = j;
      }
    }
  }
  if (best_row == rows_) return false;
  std::swap(row_of_[k], row_of_[best_row]);
  std::swap(column_of_[k], column_of_[best_column]);
  return true;
}

bool Pivoting::eliminate(double noise) {
  if (!scale_rows()) return false;
  std::iota(row_of_.begin(), row_of_.begin() + static_cast<std::ptrdiff_t>(rows_), 0U);
  std::iota(column_of_.begin(), column_of_.begin() + static_cast<std::ptrdiff_t>(columns_), 0U);
  for (rank_ = 0; rank_ < std::min(rows_, columns_) && find_pivot(rank_, noise); ++rank_) {
    const std::uint32_t pivot = row_of_[rank_], column = column_of_[rank_];
    for (std::size_t i = rank_ + 1; i < rows_; ++i) {
      const std::uint32_t row = row_of_[i];
      const double factor = at(row, column) / at(pivot, column);
      at(row, column) = factor;
      if (factor == 0.0) continue;
      for (std::size_t j = rank_ + 1; j < columns_; ++j)
        at(row, column_of_[j]) -= factor * at(pivot, column_of_[j]);
      right_[row] -= factor * right_[pivot];
    }
  }
  substitute_back();
  return true;
}

void Pivoting::solve_again() {
  for (std::size_t i = 0; i < rows_; ++i) right_[i] /= scales_[i];
  for (std::size_t k = 0; k < rank_; ++k) {
    for (std::size_t i = k + 1; i < rows_; ++i)
      right_[row_of_[i]] -= at(row_of_[i], column_of_[k]) * right_[row_of_[k]];
  }
  substitute_back();
}

void Pivoting::substitute_back() {
  for (std::size_t k = rank_; k-- > 0;) {
    double sum = right_[row_of_[k]];
    for (std::size_t j = k + 1; j < rank_; ++j) sum -= at(row_of_[k], column_of_[j]) * solution_[j];
    solution_[k] = sum / at(row_of_[k], column_of_[k]);
  }
}

bool invert(std::span<double> matrix, std::span<double> inverse, std::size_t size) {
  const auto at = [&](std::span<double> of, std::size_t i, std::size_t j) -> double& {
    return of[i * size + j];
  };
  for (std::size_t i = 0; i < size; ++i) {
    for (std::size_t j = 0; j < size; ++j) at(inverse, i, j) = i == j ? 1.0 : 0.0;
  }
  for (std::size_t k = 0; k < size; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < size; ++i) {
      if (std::abs(at(matrix, i, k)) > std::abs(at(matrix, pivot, k))) pivot = i;
    }
    const double divisor = at(matrix, pivot, k);
    if (!std::isfinite(divisor) || divisor == 0.0) return false;
    for (std::size_t j = 0; j < size; ++j) {
      std::swap(at(matrix, k, j), at(matrix, pivot, j));
      std::swap(at(inverse, k, j), at(inverse, pivot, j));
      at(matrix, k, j) /= divisor;
      at(inverse, k, j) /= divisor;
    }
    for (std::size_t i = 0; i < size; ++i) {
      const double factor = at(matrix, i, k);
      if (i == k || factor == 0.0) continue;
      for (std::size_t j = 0; j < size; ++j) {
        at(matrix, i, j) -= factor * at(matrix, k, j);
        at(inverse, i, j) -= factor * at(inverse, k, j);
      }
    }
  }
  for (std::size_t i = 0; i < size * size; ++i) {
    if (!std::isfinite(inverse[i])) return false;
  }
  return true;
}

}  // namespace hcsp::online
