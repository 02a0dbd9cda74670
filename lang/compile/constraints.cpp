// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "lang/compile/compiler.h"

namespace hcsp::lang {

void Compiler::compile_constraint(const ConstraintItem& item) {
  if (item.name) {
    constraint_ = item.name->text;
  } else {
    const auto place = item.relation->range.source->position(item.relation->range.begin);
    constraint_ = fmt::format("line {}", place.line);
    if (names_.contains(constraint_)) constraint_ += fmt::format(":{}", place.column);
  }
  state(*item.relation);
}

// A constraint that is the conjunction of several contractors numbers them.
std::string Compiler::next_name() {
  std::string name = constraint_;
  while (++names_[name] > 1) name = fmt::format("{}.{}", constraint_, names_[constraint_]);
  return name;
}

bool Compiler::calls(const Expr& expr, BuiltIn function) const {
  return expr.kind == ExprKind::call && model_.reference(*expr.operands[0]).built_in == function;
}

// Whether a relation is between reals alone: an expression, however deep.
bool Compiler::is_plain(const Expr& written) const {
  const Expr& expr = model_.unfold(written);
  if (expr.kind == ExprKind::quantified)
    return ranges_over_numbers(expr) && expr.quantifier != Quantifier::forall;
  if (calls(expr, BuiltIn::disjoint) || calls(expr, BuiltIn::meets)) return false;
  if (expr.kind != ExprKind::binary) return true;
  if (expr.op == Operator::logical_and) return is_plain(*expr.operands[0]) && is_plain(*expr.operands[1]);
  return std::none_of(expr.operands.begin(), expr.operands.end(), [&](const Expr* side) {
    const bool is_minimum = side->kind == ExprKind::quantified && !ranges_over_numbers(*side);
    return is_minimum || calls(*side, BuiltIn::der) || calls(*side, BuiltIn::distance) ||
           model_.type(*side).is(Type::Kind::set);
  });
}

void Compiler::state(const Expr& written) {
  const Expr& expr = model_.unfold(written);
  if (expr.kind == ExprKind::quantified && expr.quantifier == Quantifier::forall) {
    if (ranges_over_numbers(expr)) return state_for_each(expr);
    return state(*expr.operands[0]);  // forall(t): every relation holds then
  }
  if (is_plain(expr)) return state_relation(expr);
  if (expr.kind == ExprKind::binary && expr.op == Operator::logical_and) {
    state(*expr.operands[0]);
    state(*expr.operands[1]);
    return;
  }
  if (calls(expr, BuiltIn::disjoint)) return state_disjoint(expr);
  if (calls(expr, BuiltIn::meets)) return state_meets(expr);
  if (!state_equality(expr)) model_.diagnostics().report(Code::not_supported, expr.range, "this relation");
}

// One constraint a value, called name[1, 2].
void Compiler::state_for_each(const Expr& expr) {
  const std::string outer = constraint_;
  evaluator_.for_each(expr, [&](const std::vector<int>& at) {
    constraint_ = fmt::format("{}[{}]", outer, fmt::join(at, ", "));
    state(*expr.operands[0]);
    return !model_.diagnostics().any();
  });
  constraint_ = outer;
}

void Compiler::state_relation(const Expr& expr) {
  const Value relation = evaluator_.value(expr);
  if (relation.empty()) return;
  const auto known = Evaluator::truth(relation.front());
  if (known && *known) return;
  guarded(expr.range, [&] { problem_->constrain(next_name(), relation_of(relation.front())); });
}

// A constant that is false is a relation that no unknowns satisfy.
hcsp::Expr Compiler::relation_of(const Term& term) {
  const hcsp::Expr expr = Evaluator::expression(*problem_, term);
  return Evaluator::truth(term) ? expr == problem_->constant(Interval(1.0)) : expr;
}

bool Compiler::state_equality(const Expr& expr) {
  if (expr.kind != ExprKind::binary || expr.op != Operator::equal) return false;
  for (std::size_t side = 0; side < 2; ++side) {
    const Expr& a = *expr.operands[side];
    const Expr& b = *expr.operands[1 - side];
    if (calls(a, BuiltIn::der)) {
      state_derivative(a, b);
      return true;
    }
    if (calls(a, BuiltIn::distance) || (a.kind == ExprKind::quantified && !ranges_over_numbers(a))) {
      if (model_.type(a).is(Type::Kind::real)) {
        state_range(a, b);
        return true;
      }
    }
  }
  if (!model_.type(*expr.operands[0]).is(Type::Kind::set)) return false;
  const bool zone_first = model_.unfold(*expr.operands[0]).kind != ExprKind::name;
  state_union(*expr.operands[zone_first ? 1 : 0], *expr.operands[zone_first ? 0 : 1]);
  return true;
}

void Compiler::state_derivative(const Expr& derivative, const Expr& value) {
  const Symbol* symbol = model_.reference(*derivative.operands[1]).symbol;
  const Value terms = evaluator_.value(value);
  if (terms.empty()) return;
  VectorExpr f;
  for (const Term& term : terms) f.push_back(Evaluator::expression(*problem_, term));
  const auto& tube = std::get<TubeVariable>(unknowns_.handles.at(symbol).front());
  guarded(value.range, [&] { problem_->constrain_derivative(next_name(), tube, f); });
}

// ---- Sets.

const Symbol* Compiler::set_symbol(const Expr& written) {
  const Expr& expr = model_.unfold(written);
  if (expr.kind == ExprKind::name && model_.reference(expr).symbol != nullptr)
    return model_.reference(expr).symbol;
  model_.diagnostics().report(Code::not_supported, written.range, "this use of a set that has no name");
  return nullptr;
}

std::optional<SetBuilder> Compiler::zone_of(const Expr& written) {
  const Expr* expr = &model_.unfold(written);
  if (expr->kind == ExprKind::quantified) expr = &model_.unfold(*expr->operands[0]);
  if (expr->kind != ExprKind::builder) {
    model_.diagnostics().report(Code::not_supported, written.range, "this equation between sets");
    return {};
  }
  const std::uint32_t dim = model_.type(*expr).dim;
  const VectorExpr point = problem_->point(dim);
  evaluator_.bind(model_.reference(*expr).local, Value(point.begin(), point.end()));
  const Value relation = evaluator_.value(*expr->operands[0]);
  if (relation.empty()) return {};
  return SetBuilder{dim, Evaluator::expression(*problem_, relation.front())};
}

void Compiler::state_union(const Expr& set, const Expr& zone) {
  const Symbol* symbol = set_symbol(set);
  if (symbol == nullptr) return;
  const auto builder = zone_of(zone);
  if (!builder) return;
  guarded(zone.range, [&] { problem_->constrain_union(next_name(), set_of(*symbol), *builder); });
}

void Compiler::state_disjoint(const Expr& expr) {
  const Symbol* a = set_symbol(*expr.operands[1]);
  const Symbol* b = a == nullptr ? nullptr : set_symbol(*expr.operands[2]);
  if (b == nullptr) return;
  if (precisions_.at(a) != precisions_.at(b)) {
    model_.diagnostics().report(Code::precisions_differ, expr.range, a->name.text, precisions_.at(a),
                                b->name.text, precisions_.at(b));
    return;
  }
  guarded(expr.range, [&] { problem_->constrain_disjoint(next_name(), set_of(*a), set_of(*b)); });
}

void Compiler::state_meets(const Expr& expr) {
  const bool set_first = model_.unfold(*expr.operands[1]).kind == ExprKind::name;
  const Symbol* symbol = set_symbol(*expr.operands[set_first ? 1 : 2]);
  if (symbol == nullptr) return;
  const auto builder = zone_of(*expr.operands[set_first ? 2 : 1]);
  if (!builder) return;
  guarded(expr.range, [&] { problem_->constrain_meets(next_name(), *builder, set_of(*symbol)); });
}

void Compiler::state_range(const Expr& range, const Expr& value) {
  const bool is_distance = range.kind == ExprKind::call;
  const Symbol* map = set_symbol(is_distance ? *range.operands[2] : *range.bindings[0].domain);
  const Value z = map == nullptr ? Value{} : evaluator_.value(value);
  if (z.empty()) return;
  const VectorExpr a = problem_->point(map->type.dim);
  std::optional<hcsp::Expr> delta;
  if (is_distance) {
    const Value position = evaluator_.value(*range.operands[1]);
    if (position.empty()) return;
    VectorExpr x;
    for (const Term& term : position) x.push_back(Evaluator::expression(*problem_, term));
    delta = norm(a - x);
  } else {
    evaluator_.bind(model_.reference(range).local, Value(a.begin(), a.end()));
    const Value body = evaluator_.value(*range.operands[0]);
    if (body.empty()) return;
    delta = Evaluator::expression(*problem_, body.front());
  }
  guarded(range.range, [&] {
    problem_->constrain_range(next_name(), Evaluator::expression(*problem_, z.front()), a, *delta,
                              set_of(*map));
  });
}

}  // namespace hcsp::lang
