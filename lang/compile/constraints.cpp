// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "lang/compile/compiler.h"

namespace hcsp::lang {

void Compiler::compile_constraint(const ConstraintItem& item) {
  place_ = item.relation->range;
  if (item.name) {
    constraint_ = item.name->text;
  } else {
    const auto place = item.relation->range.source->position(item.relation->range.begin);
    constraint_ = fmt::format("line {}", place.line);
    if (names_.contains(constraint_)) constraint_ += fmt::format(":{}", place.column);
  }
  const auto outer = std::exchange(state_as_, item.is_implied     ? &Problem::imply
                                              : item.is_of_family ? &Problem::choose_family
                                                                  : &Problem::constrain);
  state(*item.relation);
  state_as_ = outer;
}

// A constraint that is the conjunction of several contractors numbers them.
std::string Compiler::next_name() {
  std::string name = constraint_;
  while (++names_[name] > 1) name = fmt::format("{}.{}", constraint_, names_[constraint_]);
  places_[name] = place_;
  return name;
}

bool Compiler::calls(const Expr& expr, BuiltIn function) const {
  return expr.kind == ExprKind::call && model_.reference(*expr.operands[0]).built_in == function;
}

void Compiler::state_relation(const Expr& expr, bool wanted) {
  if (const auto relation = relation_of(expr, wanted)) state_truth(*relation);
}

// None after a report.
std::optional<Term> Compiler::relation_of(const Expr& expr, bool wanted) {
  const Value relation = evaluator_.value(expr);
  if (relation.empty()) return {};
  if (wanted) return relation.front();
  if (const auto known = Evaluator::truth(relation.front())) return boolean(!*known);
  return !std::get<hcsp::Expr>(relation.front());
}

// A constant that is false is a relation that no unknowns satisfy.
void Compiler::state_truth(const Term& relation) {
  const auto known = Evaluator::truth(relation);
  if (known && *known) return;
  const hcsp::Expr expr = expression_of(*problem_, relation);
  const hcsp::Expr stated = known ? expr == problem_->constant(Interval(1.0)) : expr;
  (*problem_.*state_as_)(next_name(), stated);
}

// A derivative or a range alone on one side.
bool Compiler::state_equality(const Expr& expr) {
  if (expr.kind != ExprKind::binary || expr.op != Operator::equal) return false;
  for (std::size_t side = 0; side < 2; ++side) {
    const Expr& a = *expr.operands[side];
    const Expr& b = *expr.operands[1 - side];
    if (calls(a, BuiltIn::der)) {
      if (of_time_ == OfTime::this_instant) {
        not_supported(expr.range, "a derivative within a choice at every instant");
        return true;
      }
      state_derivative(a, b);
      return true;
    }
    if (calls(a, BuiltIn::distance) || (a.kind == ExprKind::quantified && !ranges_over_numbers(a))) {
      state_range(a, b);
      return true;
    }
  }
  return false;
}

void Compiler::state_derivative(const Expr& derivative, const Expr& value) {
  const auto part = evaluator_.tube(*derivative.operands[1]);
  const Value terms = part ? evaluator_.value(value) : Value{};
  if (terms.empty()) return;
  VectorExpr f;
  for (const Term& term : terms) f.push_back(expression_of(*problem_, term));
  guarded(value.range, [&] {
    if (part->dim == part->tube.dim) return problem_->constrain_derivative(next_name(), part->tube, f);
    problem_->constrain_derivative(next_name(), part->tube, part->first, f.front());
  });
}

void Compiler::state_range(const Expr& range, const Expr& value) {
  const bool is_distance = range.kind == ExprKind::call;
  const Expr& written = is_distance ? *range.operands[2] : *range.bindings[0].domain;
  const auto grid = grid_of(written, written);
  const auto map = grid ? set_variable(written, *grid) : std::nullopt;
  const Value z = map ? evaluator_.value(value) : Value{};
  if (z.empty()) return;
  const VectorExpr a = problem_->point(map->dim);
  std::optional<hcsp::Expr> delta;
  if (is_distance) {
    const Value position = evaluator_.value(*range.operands[1]);
    if (position.empty()) return;
    VectorExpr x;
    for (const Term& term : position) x.push_back(expression_of(*problem_, term));
    delta = norm(a - x);
  } else {
    evaluator_.bind(model_.reference(range).local, Value(a.begin(), a.end()));
    const bool outer = std::exchange(in_zone_, true);
    const Value body = evaluator_.value(*range.operands[0]);
    in_zone_ = outer;
    if (body.empty()) return;
    delta = expression_of(*problem_, body.front());
  }
  guarded(range.range, [&] {
    problem_->constrain_range(next_name(), expression_of(*problem_, z.front()), a, *delta, *map);
  });
}

}  // namespace hcsp::lang
