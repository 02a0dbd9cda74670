// SPDX-License-Identifier: Apache-2.0
// Operators, of numbers as long as everything is known and of expressions from then on.
#include <algorithm>

#include "lang/evaluate/evaluator.h"

namespace hcsp::lang {

namespace {

/// a < b, a > b or a != b of whole numbers: they differ by 1 at least.
hcsp::Expr apart(Operator op, const hcsp::Expr& a, const hcsp::Expr& b) {
  const Interval one(1.0);
  if (op == Operator::not_equal) return a + one <= b || b + one <= a;
  return op == Operator::less ? a + one <= b : b + one <= a;
}

/// Whether a term of this type is whole whatever the unknowns are.
bool is_whole(const Type& type, const Term& term) {
  const auto* number = std::get_if<Number>(&term);
  return number == nullptr ? type.whole : number->exact && number->exact->as_int().has_value();
}

/// A connective whose first operand decides it: the second need not exist then.
std::optional<Term> decided_by_first(Operator op, const Term& a) {
  const auto known = is_logical(op) ? Evaluator::truth(a) : std::nullopt;
  if (!known) return {};
  if (op == Operator::logical_and && !*known) return boolean(false);
  if (op == Operator::logical_or && *known) return boolean(true);
  if (op == Operator::implies && !*known) return boolean(true);
  return {};
}

/// A connective of which an operand is a constant.
std::optional<Term> known_logic(Operator op, const Term& a, const Term& b) {
  const auto p = Evaluator::truth(a), q = Evaluator::truth(b);
  if (!p && !q) return {};
  const auto negation = [](const Term& term) -> Term {
    if (const auto known = Evaluator::truth(term)) return boolean(!*known);
    return !std::get<hcsp::Expr>(term);
  };
  const bool known = p ? *p : *q;
  const Term& other = p ? b : a;
  switch (op) {
    case Operator::logical_and:
      return known ? other : boolean(false);
    case Operator::logical_or:
      return known ? boolean(true) : other;
    case Operator::implies:
      if (p) return known ? other : boolean(true);
      return known ? boolean(true) : negation(other);
    case Operator::iff:
      return known ? other : negation(other);
    default:
      return known ? negation(other) : other;
  }
}

}  // namespace

Value Evaluator::defined(const Expr& expr, Value value) {
  for (const Term& term : value) {
    const auto* number = std::get_if<Number>(&term);
    if (number == nullptr || !number->enclosure.is_empty()) continue;
    model_.diagnostics().report(Code::undefined_constant, expr.range);
    return {};
  }
  return value;
}

Value Evaluator::unary(const Expr& expr) {
  Value operand = value(*expr.operands[0]);
  if (operand.empty()) return {};
  if (expr.op == Operator::logical_not) {
    if (const auto known = truth(operand.front())) return {boolean(!*known)};
    return {!expression(operand.front())};
  }
  for (Term& term : operand) term = negate(term);
  return operand;
}

Value Evaluator::binary(const Expr& expr) {
  if (expr.op == Operator::power) return power(expr);
  if (expr.op == Operator::in) return membership(expr);
  const Value a = value(*expr.operands[0]);
  if (a.empty()) return {};
  if (const auto decided = decided_by_first(expr.op, a.front())) return {*decided};
  const Value b = value(*expr.operands[1]);
  if (b.empty()) return {};
  if (is_comparison(expr.op)) return relation(expr, a, b);
  if (is_logical(expr.op)) return {connect(expr.op, a.front(), b.front())};
  return arithmetic(expr, a, b);
}

Term Evaluator::connect(Operator op, const Term& a, const Term& b) {
  if (const auto known = known_logic(op, a, b)) return *known;
  const hcsp::Expr p = expression(a);
  const hcsp::Expr q = expression(b);
  switch (op) {
    case Operator::logical_and:
      return p && q;
    case Operator::logical_or:
      return p || q;
    case Operator::implies:
      return !p || q;
    case Operator::iff:
      return (p && q) || (!p && !q);
    default:
      return (p && !q) || (!p && q);
  }
}

Value Evaluator::arithmetic(const Expr& expr, const Value& a, const Value& b) {
  const Type &of_a = model_.type(*expr.operands[0]), &of_b = model_.type(*expr.operands[1]);
  if (expr.op == Operator::multiply && !of_a.is_scalar() && !of_b.is_scalar() && of_a.is(Type::Kind::real))
    return product(expr, a, b);
  Value result;
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
    result.push_back(operate(expr.op, a[a.size() == 1 ? 0 : i], b[b.size() == 1 ? 0 : i]));
  }
  return defined(expr, std::move(result));
}

Value Evaluator::power(const Expr& expr) {
  const Value base = value(*expr.operands[0]);
  const Value exponent = base.empty() ? Value{} : value(*expr.operands[1]);
  if (exponent.empty()) return {};
  return defined(expr, {power_of(base.front(), exponent.front())});
}

Value Evaluator::relation(const Expr& expr, const Value& a, const Value& b) {
  const bool any = expr.op == Operator::not_equal;
  if (model_.type(*expr.operands[0]).is(Type::Kind::boolean))
    return {connect(any ? Operator::logical_xor : Operator::iff, a.front(), b.front())};
  std::optional<hcsp::Expr> all;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (const auto known = known_relation(expr.op, a[i], b[i])) {
      if (*known == any) return {boolean(any)};
      continue;
    }
    const bool strict =
        expr.op == Operator::less || expr.op == Operator::greater || expr.op == Operator::not_equal;
    const bool whole_sides =
        is_whole(model_.type(*expr.operands[0]), a[i]) && is_whole(model_.type(*expr.operands[1]), b[i]);
    const hcsp::Expr one = strict && whole_sides ? apart(expr.op, expression(a[i]), expression(b[i]))
                                                 : compare(expr.op, expression(a[i]), expression(b[i]));
    all = !all ? one : any ? *all || one : *all && one;
  }
  return {all ? Term(*all) : boolean(!any)};
}

Value Evaluator::membership(const Expr& expr) {
  const Value point = value(*expr.operands[0]);
  if (model_.type(*expr.operands[1]).is(Type::Kind::set))
    return membership_in_builder(*expr.operands[1], point);
  const DomainValue bounds = domain(*expr.operands[1]);
  if (point.empty() || bounds.empty()) return {};
  std::optional<hcsp::Expr> all;
  const auto add = [&](const Term& below, const Term& above) {
    const hcsp::Expr one = expression(below) <= expression(above);
    all = all ? *all && one : one;
  };
  for (std::size_t i = 0; i < point.size(); ++i) {
    if (bounds[i].lo) add(*bounds[i].lo, point[i]);
    if (bounds[i].hi) add(point[i], *bounds[i].hi);
  }
  if (!all) return {boolean(true)};
  return {*all};
}

// The point is in { a | relation } when the relation holds of it.
Value Evaluator::membership_in_builder(const Expr& written, const Value& point) {
  if (point.empty()) return {};
  const Expr& builder = model_.unfold(written);
  const std::uint32_t local = model_.reference(builder).local;
  Value outer = std::exchange(locals_[local], point);
  Value relation = value(*builder.operands[0]);
  locals_[local] = std::move(outer);
  return relation;
}

Value Evaluator::conditional(const Expr& expr) {
  const Value condition = value(*expr.operands[0]);
  if (condition.empty()) return {};
  // What is not taken need not exist: x[i - 1] under `if i > 1`.
  if (const auto known = truth(condition.front())) return value(*expr.operands[*known ? 1 : 2]);
  const Value then = value(*expr.operands[1]);
  const Value otherwise = value(*expr.operands[2]);
  if (then.empty() || otherwise.empty()) return {};
  Value result;
  for (std::size_t i = 0; i < then.size(); ++i) {
    result.push_back(
        if_then_else(expression(condition.front()), expression(then[i]), expression(otherwise[i])));
  }
  return result;
}

}  // namespace hcsp::lang
