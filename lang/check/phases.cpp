// SPDX-License-Identifier: Apache-2.0
// Time lines with phases: `time t in [0, T] phases tau`, `hold(f)` and `gate(k)`.
#include <algorithm>

#include "lang/check/checker.h"

namespace hcsp::lang {

void Checker::check_phases(const TimeItem& item) {
  check_span_of_phases(*item.span);
  const Type durations = check(*item.phases);
  if (durations.is_error()) return;
  if (!durations.is(Type::Kind::real) || !durations.is_vector() || durations.tube)
    diagnostics().report(Code::wrong_type, item.phases->range, "a vector of durations", describe(durations));
}

// From 0 to an unknown: its bounds are no constants.
void Checker::check_span_of_phases(const Expr& span) {
  const Type type = check(span);
  if (type.is_error()) return;
  const bool is_interval = span.kind == ExprKind::interval && !type.tube;
  if (!is_interval) {
    diagnostics().report(Code::wrong_type, span.range, "an interval `[0, T]`", describe(type));
    return;
  }
  const Expr &start = *span.operands[0], &end = *span.operands[1];
  for (const Expr* bound : {&start, &end}) {
    if (!model_.type(*bound).is_error()) continue;  // oo
    diagnostics().report(Code::misplaced_infinity, bound->range);
    return;
  }
  const auto zero = model_.type(start).known == Known::now ? constants_.number(start) : std::nullopt;
  if (!zero || !(zero->enclosure == Interval(0.0)))
    diagnostics().report(Code::no_gate, start.range, "a time line with phases starts at 0");
}

// A number a phase, or a vector a phase: the rows of a matrix.
Type Checker::check_hold_in_phases(const Expr& expr, const Type& values) {
  if (!model_.has_phases()) {
    check_count(expr, "hold", 2, 2);
    return {};
  }
  const Expr& written = *expr.operands[1];
  if (!values.is(Type::Kind::real) || values.tube || values.is_array() || values.dim == 0) {
    diagnostics().report(Code::wrong_type, written.range, "a vector of a number a phase", describe(values));
    return {};
  }
  const Type durations = model_.type(*model_.time->as<TimeItem>()->phases);
  if (durations.is_error()) return {};
  if (values.dim != durations.dim) {
    diagnostics().report(Code::sizes_differ, written.range, describe(values), describe(durations));
    return {};
  }
  return {Type::Kind::real, true, values.columns, Known::by_solving, nullptr};
}

Type Checker::check_gate(const Expr& expr, const Type& count) {
  if (!model_.has_phases()) {
    diagnostics().report(Code::no_gate, expr.range, "only a time line with phases has gates");
    return {};
  }
  if (!require_scalar(*expr.operands[1], count) || !require_known(*expr.operands[1], count)) return {};
  return {Type::Kind::real, false, 0, Known::by_solving, nullptr};
}

// Whether a relation that holds of numbers holds at every instant where each of its comparisons does.
bool Checker::holds_pointwise(const Expr& written) const {
  const Expr& relation = model_.unfold(written);
  if (relation.kind == ExprKind::quantified)
    return relation.quantifier == Quantifier::forall && holds_pointwise(*relation.operands[0]);
  if (relation.kind != ExprKind::binary) return false;
  if (relation.op == Operator::logical_and)
    return holds_pointwise(*relation.operands[0]) && holds_pointwise(*relation.operands[1]);
  return relation.op == Operator::in ||
         (is_comparison(relation.op) && model_.type(*relation.operands[0]).is(Type::Kind::real));
}

}  // namespace hcsp::lang
