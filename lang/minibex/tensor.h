// SPDX-License-Identifier: Apache-2.0
// The values of Minibex expressions: matrices of terms. A number is 1 x 1, a vector is a column, and what has
// one row is the row vector of IBEX.
#pragma once

#include <string>

#include "lang/evaluate/terms.h"

namespace hcsp::lang::minibex {

struct Tensor {
  std::size_t rows = 1;
  std::size_t columns = 1;
  Value terms;  ///< row after row; none after an error, which has been reported

  Tensor() = default;
  Tensor(const Term& term) : terms{term} {}  // NOLINT(google-explicit-constructor): a number is a matrix
  Tensor(std::size_t r, std::size_t c, Value v) : rows(r), columns(c), terms(std::move(v)) {}

  [[nodiscard]] bool failed() const { return terms.empty(); }
  [[nodiscard]] bool is_scalar() const { return rows == 1 && columns == 1; }
  [[nodiscard]] bool is_vector() const { return (rows == 1) != (columns == 1); }
  [[nodiscard]] bool has_shape_of(const Tensor& other) const {
    return rows == other.rows && columns == other.columns;
  }
};

/// "a number", "a vector of 3", "a row of 3", "a 2 x 3 matrix".
std::string describe(const Tensor& tensor);

/// a op b for one of + - * / ^; none where the shapes do not fit. Sums are of equal shapes; a product has a
/// number on one side, or is that of matrices, or of two vectors alike the dot product; what is divided by is
/// a number, and so are both sides of a power.
std::optional<Tensor> combine(Operator op, const Tensor& a, const Tensor& b);
/// How many operations on terms that takes.
std::uint64_t operations(Operator op, const Tensor& a, const Tensor& b);
Tensor negated(Tensor a);
Tensor transposed(const Tensor& a);
/// The parts side by side, or one below the other; none where they do not fit.
std::optional<Tensor> joined(const std::vector<Tensor>& parts, bool side_by_side);
/// Rows and columns [first, last] of each.
struct Extent {
  std::size_t first = 0;
  std::size_t last = 0;
};
Tensor part(const Tensor& whole, Extent rows, Extent columns);

}  // namespace hcsp::lang::minibex
