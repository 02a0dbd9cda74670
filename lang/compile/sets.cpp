// SPDX-License-Identifier: Apache-2.0
// Relations between sets. A set expression is put together from hidden sets on the grid of the finest set
// that the relation names; with complements, intersection makes every operation but the symmetric difference.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "lang/compile/compiler.h"

namespace hcsp::lang {

namespace {

SetTerm complement(SetTerm term) { return {term.set, !term.complemented}; }

}  // namespace

void Compiler::state_set_relation(const Expr& expr, bool wanted) {
  const bool is_call = expr.kind == ExprKind::call;
  const Expr &a = *expr.operands[is_call ? 1 : 0], &b = *expr.operands[is_call ? 2 : 1];
  if (of_time_ != OfTime::this_instant && speaks_of_each_instant(expr, a, b, wanted))
    return state_at_each_instant(expr, wanted);
  if (calls(expr, BuiltIn::disjoint)) return state_disjoint(a, b, wanted);
  if (calls(expr, BuiltIn::meets)) return state_meets(a, b, wanted);
  if (is_call || expr.op == Operator::subset) return state_subset(a, b, wanted);
  if (expr.op == Operator::in) return state_point_in_set(a, b, wanted);
  state_set_equality(a, b, (expr.op == Operator::equal) == wanted);
}

// ---- Relations.

void Compiler::state_set_equality(const Expr& a, const Expr& b, bool wanted) {
  const auto grid = grid_of(a, b);
  if (!grid) return;
  guarded(a.range, [&] {
    if (!wanted) {
      const auto one = set_term(a, *grid), other = one ? set_term(b, *grid) : std::nullopt;
      if (!other) return;
      const SetTerm difference{problem_->hidden_set(constraint_ + " difference", *grid).id};
      problem_->constrain_symmetric_difference(next_name(), difference, *one, *other);
      problem_->constrain_common_point(next_name(), difference, difference);
      return;
    }
    const Expr &left = model_.unfold(a), &right = model_.unfold(b);
    const bool is_named = evaluator_.set(left).has_value();
    const auto whole = set_term(is_named ? left : right, *grid);
    if (whole) define_set(*whole, is_named ? right : left, *grid);
  });
}

// Of a set that varies with time the union over time, or the intersection, is meant: for "at every instant"
// is all that a subset or disjoint sets say of it.
void Compiler::state_subset(const Expr& a, const Expr& b, bool wanted) {
  const auto grid = grid_of(a, b);
  if (!grid) return;
  guarded(a.range, [&] {
    const auto part = set_term(a, *grid), whole = part ? set_term(b, *grid, true) : std::nullopt;
    if (!whole) return;
    if (wanted) {
      problem_->constrain_subset(next_name(), *part, *whole);
    } else {
      problem_->constrain_common_point(next_name(), *part, complement(*whole));
    }
  });
}

void Compiler::state_disjoint(const Expr& a, const Expr& b, bool wanted) {
  if (!wanted) return state_meets(a, b, true);
  const auto grid = grid_of(a, b);
  if (!grid) return;
  guarded(a.range, [&] {
    const auto one = set_term(a, *grid), other = one ? set_term(b, *grid) : std::nullopt;
    if (!other) return;
    if (one->complemented || other->complemented) {
      problem_->constrain_subset(next_name(), *one, complement(*other));
    } else {
      problem_->constrain_disjoint(next_name(), {one->set, grid->dim}, {other->set, grid->dim});
    }
  });
}

// Of a set builder the unknowns in its relation are contracted too.
void Compiler::state_meets(const Expr& a, const Expr& b, bool wanted) {
  if (!wanted) return state_disjoint(a, b, true);
  const auto grid = grid_of(a, b);
  if (!grid) return;
  const auto is_builder = [&](const Expr& set) { return model_.unfold(set).kind == ExprKind::builder; };
  guarded(a.range, [&] {
    const bool zone_first = is_builder(a) && !evaluator_.varies(b);
    if (zone_first || is_builder(b)) {
      const auto builder = zone_of(zone_first ? a : b);
      const auto set = builder ? set_variable(zone_first ? b : a, *grid) : std::nullopt;
      if (set) problem_->constrain_meets(next_name(), *builder, *set);
      return;
    }
    const auto one = set_term(a, *grid), other = one ? set_term(b, *grid) : std::nullopt;
    if (other) problem_->constrain_common_point(next_name(), *one, *other);
  });
}

// The point is in the set when the set of this one point meets it.
void Compiler::state_point_in_set(const Expr& point, const Expr& set, bool wanted) {
  const auto grid = grid_of(set, set);
  const Value terms = grid ? evaluator_.value(point) : Value{};
  if (terms.empty()) return;
  guarded(point.range, [&] {
    auto term = set_term(set, *grid);
    if (!term) return;
    if (!wanted) term = complement(*term);
    const SetVariable home = set_equal_to(*term, *grid);
    const VectorExpr bound = problem_->point(grid->dim);
    VectorExpr position;
    for (const Term& coordinate : terms) position.push_back(expression_of(*problem_, coordinate));
    problem_->constrain_meets(next_name(), {grid->dim, bound == position}, home);
  });
}

// ---- Expressions.

void Compiler::collect_sets(const Expr& written, std::vector<NamedSet>& found) {
  const Expr& expr = model_.unfold(written);
  if (const auto set = evaluator_.set(expr)) found.push_back({&written, *set});
  const bool is_made_of_sets = expr.kind == ExprKind::binary || calls(expr, BuiltIn::complement) ||
                               (expr.kind == ExprKind::quantified && ranges_over_numbers(expr));
  if (!is_made_of_sets) return;
  const auto collect = [&] {
    for (const Expr* operand : expr.operands) {
      if (model_.type(*operand).is(Type::Kind::set)) collect_sets(*operand, found);
    }
  };
  if (expr.kind != ExprKind::quantified) return collect();
  evaluator_.for_each(expr, [&](const std::vector<int>&) {
    collect();
    return true;
  });
}

// Whether a relation says nothing of what its sets are over time: both of them vary, one is more than a zone,
// or a point is asked for at every instant, where but a plain zone is felt over time.
bool Compiler::speaks_of_each_instant(const Expr& expr, const Expr& a, const Expr& b, bool wanted) const {
  if (!evaluator_.varies(a) && !evaluator_.varies(b)) return false;
  if (model_.type(a).is(Type::Kind::real)) return evaluator_.varies(b);
  if (evaluator_.varies(a) && evaluator_.varies(b)) return true;
  const Expr& varying = model_.unfold(evaluator_.varies(a) ? a : b);
  if (calls(expr, BuiltIn::meets) != wanted) return !is_zone(varying) && !calls(varying, BuiltIn::complement);
  return calls(expr, BuiltIn::subset) || expr.op == Operator::subset || varying.kind != ExprKind::builder;
}

// The finest of the sets that the two sides of a relation name; all are on its grid, or on coarser ones that
// it refines.
std::optional<SetVariable> Compiler::grid_of(const Expr& a, const Expr& b) {
  std::vector<NamedSet> named;
  const std::size_t before = model_.diagnostics().count();
  collect_sets(a, named);
  if (&a != &b) collect_sets(b, named);
  if (model_.diagnostics().count() != before) return {};
  const auto precision = [&](const NamedSet& one) { return problem_->precision(one.set); };
  const auto finest = std::min_element(named.begin(), named.end(), [&](const auto& one, const auto& other) {
    return precision(one) < precision(other);
  });
  if (finest == named.end()) {
    model_.diagnostics().report(Code::no_grid, a.range);
    return {};
  }
  for (const NamedSet& one : named) {
    int exponent = 0;
    if (std::frexp(precision(one) / precision(*finest), &exponent) == 0.5) continue;
    model_.diagnostics().report(Code::precisions_differ, one.expr->range, one.expr->range.text(),
                                precision(one), finest->expr->range.text(), precision(*finest));
    return {};
  }
  return finest->set;
}

// A set on a grid, or its complement. None after a report.
std::optional<SetTerm> Compiler::set_term(const Expr& written, SetVariable grid, bool meet_over_time) {
  const Expr& expr = model_.unfold(written);
  const std::size_t before = model_.diagnostics().count();
  if (const auto named = evaluator_.set(expr)) {
    if (problem_->precision(*named) == problem_->precision(grid)) return SetTerm{named->id};
    return SetTerm{problem_->refined(*named, grid).id};
  }
  if (model_.diagnostics().count() != before) return {};
  if (calls(expr, BuiltIn::complement)) {
    const auto inner = set_term(*expr.operands[1], grid, !meet_over_time);
    return inner ? std::optional(complement(*inner)) : std::nullopt;
  }
  const SetVariable made = problem_->hidden_set(constraint_ + " set", grid);
  // What is in all sets of a time is in the complement of no one of them.
  if (meet_over_time && evaluator_.varies(expr) && is_zone(expr)) {
    const auto outside = zone_of(expr, false);
    if (!outside) return {};
    problem_->constrain_union(next_name(), made, *outside);
    return SetTerm{made.id, true};
  }
  return define_set({made.id}, expr, grid) ? std::optional(SetTerm{made.id}) : std::nullopt;
}

std::optional<SetVariable> Compiler::set_variable(const Expr& expr, SetVariable grid) {
  const auto term = set_term(expr, grid);
  return term ? std::optional(set_equal_to(*term, grid)) : std::nullopt;
}

void Compiler::state_same(SetTerm a, SetTerm b) {
  problem_->constrain_subset(next_name(), a, b);
  problem_->constrain_subset(next_name(), b, a);
}

SetVariable Compiler::set_equal_to(SetTerm term, SetVariable grid) {
  if (!term.complemented) return {term.set, grid.dim};
  const SetVariable made = problem_->hidden_set(constraint_ + " complement", grid);
  state_same({made.id}, term);
  return made;
}

// States whole == expr; false after a report.
bool Compiler::define_set(SetTerm whole, const Expr& written, SetVariable grid) {
  const Expr& expr = model_.unfold(written);
  const bool ranges = expr.kind == ExprKind::quantified && ranges_over_numbers(expr);
  if (ranges) return define_by_folding(whole, expr, grid);
  const bool meets_over_time = expr.kind == ExprKind::quantified && expr.quantifier == Quantifier::set_inter;
  if (is_zone(expr)) {
    const auto zone = zone_of(expr, !meets_over_time);
    if (!zone) return false;
    if (meets_over_time) whole = complement(whole);
    const SetVariable plain = set_equal_to(whole, grid);
    problem_->constrain_union(next_name(), plain, *zone);
    return true;
  }
  if (expr.kind != ExprKind::binary) {
    const auto same = set_term(expr, grid);
    if (same) state_same(whole, *same);
    return same.has_value();
  }
  auto a = set_term(*expr.operands[0], grid);
  auto b = a ? set_term(*expr.operands[1], grid) : std::nullopt;
  if (!b) return false;
  if (expr.op == Operator::set_symdiff) {
    problem_->constrain_symmetric_difference(next_name(), whole, *a, *b);
    return true;
  }
  const bool unites = expr.op == Operator::set_union;
  if (unites) std::tie(whole, a, b) = std::tuple(complement(whole), complement(*a), complement(*b));
  if (expr.op == Operator::set_minus) b = complement(*b);
  problem_->constrain_intersection(next_name(), whole, *a, *b);
  return true;
}

// union(i in 1..n) and inter(i in 1..n), one set after another.
bool Compiler::define_by_folding(SetTerm whole, const Expr& expr, SetVariable grid) {
  const bool unites = expr.quantifier == Quantifier::set_union;
  const auto side = [unites](SetTerm term) { return unites ? complement(term) : term; };
  std::vector<SetTerm> parts;
  const bool done = evaluator_.for_each(expr, [&](const std::vector<int>&) {
    const auto part = set_term(*expr.operands[0], grid);
    if (part) parts.push_back(side(*part));
    return part.has_value();
  });
  if (!done) return false;
  if (parts.empty()) {
    model_.diagnostics()
        .report(Code::undefined_constant, expr.range)
        .note(fmt::format("there is no set to take the {} of", unites ? "union" : "intersection"));
    return false;
  }
  SetTerm common = parts.front();
  for (std::size_t i = 1; i + 1 < parts.size(); ++i) {
    const SetTerm next{problem_->hidden_set(constraint_ + " set", grid).id};
    problem_->constrain_intersection(next_name(), next, common, parts[i]);
    common = next;
  }
  if (parts.size() == 1) {
    state_same(side(whole), common);
  } else {
    problem_->constrain_intersection(next_name(), side(whole), common, parts.back());
  }
  return true;
}

// A set builder, or a union or intersection of one over time.
bool Compiler::is_zone(const Expr& written) const {
  const Expr& expr = model_.unfold(written);
  if (expr.kind == ExprKind::builder) return true;
  return expr.kind == ExprKind::quantified && !ranges_over_numbers(expr) &&
         model_.unfold(*expr.operands[0]).kind == ExprKind::builder;
}

// The points for which the relation of a zone holds, or does not. None after a report.
std::optional<SetBuilder> Compiler::zone_of(const Expr& written, bool wanted) {
  const Expr* expr = &model_.unfold(written);
  if (expr->kind == ExprKind::quantified) {  // it binds t anew, whatever instant stands around it
    std::optional<SetBuilder> zone;
    if (of_time_ == OfTime::this_instant) {
      not_supported(expr->range, "a set over time within a choice at every instant");
      return {};
    }
    evaluator_.at({}, [&] { zone = zone_of(*expr->operands[0], wanted); });
    return zone;
  }
  const std::uint32_t dim = model_.type(*expr).dim;
  const VectorExpr point = problem_->point(dim);
  evaluator_.bind(model_.reference(*expr).local, Value(point.begin(), point.end()));
  const bool outer = std::exchange(in_zone_, true);
  const auto relation = relation_of(*expr->operands[0], wanted);
  in_zone_ = outer;
  if (!relation) return {};
  const hcsp::Expr zone = expression_of(*problem_, *relation);
  const bool is_constant = Evaluator::truth(*relation).has_value();
  return SetBuilder{dim, is_constant ? zone == problem_->constant(Interval(1.0)) : zone};
}

}  // namespace hcsp::lang
