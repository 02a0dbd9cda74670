// SPDX-License-Identifier: Apache-2.0
#include "lang/minibex/tensor.h"

#include <fmt/format.h>

#include <algorithm>

namespace hcsp::lang::minibex {

namespace {

Tensor termwise(Operator op, const Tensor& a, const Tensor& b) {
  Tensor result(std::max(a.rows, b.rows), std::max(a.columns, b.columns), {});
  const std::size_t count = std::max(a.terms.size(), b.terms.size());
  result.terms.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
    result.terms.push_back(operate(op, a.terms[a.is_scalar() ? 0 : i], b.terms[b.is_scalar() ? 0 : i]));
  return result;
}

std::optional<Tensor> product(const Tensor& a, const Tensor& b) {
  if (a.is_scalar() || b.is_scalar()) return termwise(Operator::multiply, a, b);
  if (a.columns == b.rows)
    return Tensor(a.rows, b.columns, matrix_product(a.terms, b.terms, a.columns, b.columns));
  if (a.is_vector() && a.has_shape_of(b)) return Tensor(dot(a.terms, b.terms));
  return {};
}

}  // namespace

std::string describe(const Tensor& tensor) {
  if (tensor.is_scalar()) return "a number";
  if (tensor.columns == 1) return fmt::format("a vector of {}", tensor.rows);
  if (tensor.rows == 1) return fmt::format("a row of {}", tensor.columns);
  return fmt::format("a {} x {} matrix", tensor.rows, tensor.columns);
}

std::optional<Tensor> combine(Operator op, const Tensor& a, const Tensor& b) {
  switch (op) {
    case Operator::add:
    case Operator::subtract:
      return a.has_shape_of(b) ? std::optional(termwise(op, a, b)) : std::nullopt;
    case Operator::multiply:
      return product(a, b);
    case Operator::divide:
      return b.is_scalar() ? std::optional(termwise(op, a, b)) : std::nullopt;
    default:
      if (!a.is_scalar() || !b.is_scalar()) return {};
      return Tensor(power_of(a.terms.front(), b.terms.front()));
  }
}

std::uint64_t operations(Operator op, const Tensor& a, const Tensor& b) {
  const bool is_product = op == Operator::multiply && !a.is_scalar() && a.columns == b.rows;
  return is_product ? a.terms.size() * b.columns : std::max(a.terms.size(), b.terms.size());
}

Tensor negated(Tensor a) {
  for (Term& term : a.terms) term = negate(term);
  return a;
}

Tensor transposed(const Tensor& a) { return {a.columns, a.rows, transposed(a.terms, a.rows, a.columns)}; }

std::optional<Tensor> joined(const std::vector<Tensor>& parts, bool side_by_side) {
  Tensor result(0, 0, {});
  const std::size_t across = side_by_side ? parts.front().rows : parts.front().columns;
  for (const Tensor& part : parts) {
    if ((side_by_side ? part.rows : part.columns) != across) return {};
    result.rows += part.rows;
    result.columns += part.columns;
  }
  (side_by_side ? result.rows : result.columns) = across;
  for (std::size_t row = 0; row < (side_by_side ? across : 1); ++row) {
    for (const Tensor& part : parts) {
      const std::size_t count = side_by_side ? part.columns : part.terms.size();
      const auto begin = part.terms.begin() + static_cast<std::ptrdiff_t>(row * part.columns);
      result.terms.insert(result.terms.end(), begin, begin + static_cast<std::ptrdiff_t>(count));
    }
  }
  return result;
}

Tensor part(const Tensor& whole, Extent rows, Extent columns) {
  Tensor result(rows.last - rows.first + 1, columns.last - columns.first + 1, {});
  result.terms.reserve(result.rows * result.columns);
  for (std::size_t row = rows.first; row <= rows.last; ++row) {
    for (std::size_t column = columns.first; column <= columns.last; ++column)
      result.terms.push_back(whole.terms[row * whole.columns + column]);
  }
  return result;
}

}  // namespace hcsp::lang::minibex
