// SPDX-License-Identifier: Apache-2.0
// Components and parts: x(i), x[i], M(i, j), M(i, :), x(1:3).
#include "lang/minibex/evaluator.h"

namespace hcsp::lang::minibex {

Tensor Evaluator::apply(const Expr& expr) {
  const Expr& base = *expr.operands[0];
  if (base.kind != Kind::name) {
    const Tensor whole = value(base);
    return whole.failed() ? Tensor() : indexed(whole, expr);
  }
  if (const Tensor* found = visible(base))
    return found->failed() ? Tensor() : as_wanted(expr, indexed(*found, expr));
  if (!expr.brackets) return call(expr);
  unknown_name(base, Code::unknown_name);
  return {};
}

// One index is a row's, save of a row vector, where it is a column's.
Tensor Evaluator::indexed(const Tensor& base, const Expr& expr) {
  constexpr std::size_t kMostIndices = 2;
  const std::size_t count = expr.operands.size() - 1;
  if (count > kMostIndices) {
    diagnostics_.report(Code::wrong_argument_count, expr.range, expr.operands[0]->range.text(),
                        "one or two indices", count);
    return {};
  }
  const bool by_row = count == kMostIndices || base.rows > 1;
  const auto first = extent(*expr.operands[1], by_row ? base.rows : base.columns, expr.brackets);
  if (!first) return {};
  if (count == kMostIndices) {
    const auto second = extent(*expr.operands[2], base.columns, expr.brackets);
    return second ? part(base, *first, *second) : Tensor();
  }
  if (by_row) return part(base, *first, {0, base.columns - 1});
  return part(base, {0, 0}, *first);
}

std::optional<Extent> Evaluator::extent(const Expr& index, std::size_t size, bool from_zero) {
  if (index.kind == Kind::all) return Extent{0, size - 1};
  const bool is_span = index.kind == Kind::span;
  const int origin = from_zero ? 0 : 1;
  const auto place = [&](const Expr& written) -> std::optional<std::size_t> {
    const auto at = whole(written);
    if (!at) return {};
    const std::int64_t last = static_cast<std::int64_t>(size) - 1 + origin;
    if (*at >= origin && *at <= last) return static_cast<std::size_t>(*at - origin);
    diagnostics_.report(Code::index_outside, written.range, *at, origin, last)
        .note(from_zero ? "x[i] counts from 0, x(i) from 1" : "x(i) counts from 1, x[i] from 0");
    return {};
  };
  const auto first = place(is_span ? *index.operands[0] : index);
  const auto last = is_span && first ? place(*index.operands[1]) : first;
  if (!last) return {};
  if (*first <= *last) return Extent{*first, *last};
  diagnostics_.report(Code::empty_interval, index.range);
  return {};
}

}  // namespace hcsp::lang::minibex
