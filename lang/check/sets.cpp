// SPDX-License-Identifier: Apache-2.0
#include "lang/check/checker.h"

namespace hcsp::lang {

namespace {

bool is_set_operation(const Expr& expr) {
  return expr.kind == ExprKind::binary &&
         (expr.op == Operator::set_union || expr.op == Operator::set_inter ||
          expr.op == Operator::set_minus || expr.op == Operator::set_symdiff);
}

bool is_union_or_intersection(const Expr& expr) {
  return expr.kind == ExprKind::quantified &&
         (expr.quantifier == Quantifier::set_union || expr.quantifier == Quantifier::set_inter);
}

bool is_complement(const Expr& expr) {
  return expr.kind == ExprKind::call && expr.operands.size() == 2 &&
         expr.operands[0]->kind == ExprKind::name && expr.operands[0]->text == "complement";
}

// Whether an expression is a set builder, or made of ones, that does not say its dimension.
bool wants_dimension(const Expr& expr) {
  if (expr.kind == ExprKind::builder) return expr.bindings[0].type == nullptr;
  if (is_set_operation(expr)) return wants_dimension(*expr.operands[0]) && wants_dimension(*expr.operands[1]);
  if (is_complement(expr)) return wants_dimension(*expr.operands[1]);
  return is_union_or_intersection(expr) && wants_dimension(*expr.operands[0]);
}

// The dimension of a set, or of the sets that a point may be in.
std::uint32_t dimension_of(const Type& type) {
  return type.is(Type::Kind::real) && type.is_scalar() ? 1 : type.dim;
}

}  // namespace

std::pair<Type, Type> Checker::check_pair(const Expr& a, const Expr& b) {
  if (wants_dimension(a)) {
    const Type right = check(b);
    if (right.is_error()) return {};
    return {check_set(a, dimension_of(right)), right};
  }
  const Type left = check(a);
  if (!wants_dimension(b)) return {left, check(b)};
  if (left.is_error()) return {};
  return {left, check_set(b, dimension_of(left))};
}

Type Checker::check_set(const Expr& expr, std::uint32_t dim) {
  if (dim == 0 || !wants_dimension(expr)) return check(expr);
  Type type;
  if (expr.kind == ExprKind::builder) {
    type = check_builder(expr, dim);
  } else if (is_set_operation(expr)) {
    const Type a = check_set(*expr.operands[0], dim);
    const Type b = check_set(*expr.operands[1], dim);
    if (!a.is_error() && !b.is_error()) type = check_set_operation(expr, a, b);
  } else if (is_complement(expr)) {
    type = check_complement(expr, dim);
  } else {
    type = check_quantified(expr, dim);
  }
  model_.set_type(expr, type);
  return type;
}

Type Checker::check_builder(const Expr& expr, std::uint32_t dim) {
  const Binding& point = expr.bindings[0];
  Type type{Type::Kind::real, false, dim, Known::by_solving, nullptr};
  if (point.type != nullptr) {
    type = resolve(*point.type);
    if (type.is_error()) return {};
    if (type.tube || !type.is(Type::Kind::real)) {
      diagnostics().report(Code::wrong_type, point.type->range, "`real[2]`", describe(type));
      return {};
    }
  }
  if (type.dim == 0) {
    diagnostics().report(Code::unknown_dimension, point.name.range, point.name.text);
    return {};
  }
  if (type.dim > 3) {
    diagnostics().report(Code::bad_set_dimension, point.name.range, describe(type));
    return {};
  }
  if (dim != 0 && type.dim != dim) {
    diagnostics().report(Code::wrong_type, point.name.range, fmt::format("`real[{}]`", dim), describe(type));
    return {};
  }
  const std::uint32_t local = bind(point.name.text, type);
  model_.set_reference(expr, {nullptr, local, BuiltIn::none});
  const bool pointwise = std::exchange(pointwise_, true);
  const Type relation = check(*expr.operands[0]);
  pointwise_ = pointwise;
  locals_.pop_back();
  if (relation.is_error()) return {};
  if (!relation.is(Type::Kind::boolean)) {
    diagnostics().report(Code::wrong_type, expr.operands[0]->range, "a relation", describe(relation));
    return {};
  }
  return {Type::Kind::set, relation.tube, type.dim, Known::by_solving, nullptr};
}

// Binds the time at hand, within a window where `t in [a, b]` states one, whose ends are instants then.
bool Checker::binds_time(const Expr& expr) {
  const Binding& bound = expr.bindings[0];
  if (model_.time == nullptr || expr.bindings.size() > 1 || bound.name.text != model_.time->name.text) {
    auto& diagnostic = diagnostics().report(Code::not_the_time, bound.name.range, bound.name.text);
    if (model_.time != nullptr) diagnostic.note(fmt::format("the time line is `{}`", model_.time->name.text));
    return false;
  }
  if (bound.domain == nullptr) return true;
  const Type window = check(*bound.domain);
  if (window.is_error()) return false;
  if (bound.domain->kind != ExprKind::interval || !window.is(Type::Kind::domain)) {
    diagnostics().report(Code::wrong_type, bound.domain->range, "a span of time `[a, b]`", describe(window));
    return false;
  }
  // Whether they are gates of phases the compiler sees.
  if (!model_.has_phases() && !require_constant(*bound.domain, window)) return false;
  for (const Expr* end : bound.domain->operands) {
    if (model_.type(*end).is_error()) {  // oo
      diagnostics().report(Code::misplaced_infinity, end->range);
      return false;
    }
    if (!model_.has_phases()) model_.instants.push_back(end);
  }
  return true;
}

Type Checker::check_quantified(const Expr& expr, std::uint32_t dim) {
  if (is_union_or_intersection(expr)) return check_union(expr, dim);
  if (ranges_over_numbers(expr)) return check_over_range(expr);
  switch (expr.quantifier) {
    case Quantifier::forall:
    case Quantifier::exists:
      return ranges_over_reals(expr) ? check_over_reals(expr) : check_over_time(expr);
    case Quantifier::minimum:
      return check_minimum(expr);
    default:
      return not_supported(expr.range, fmt::format("`{}` with bound names", spelling(expr.quantifier)));
  }
}

// forall(t) and exists(t).
Type Checker::check_over_time(const Expr& expr) {
  if (!binds_time(expr)) return {};
  if (model_.has_phases() && expr.quantifier != Quantifier::forall)
    return not_supported(expr.range, "`exists` on a time line with phases");
  const bool nested = std::exchange(pointwise_, true);
  const Type body = check(*expr.operands[0]);
  pointwise_ = nested;
  if (body.is_error()) return {};
  if (!body.is(Type::Kind::boolean)) {
    diagnostics().report(Code::wrong_type, expr.operands[0]->range, "a relation", describe(body));
    return {};
  }
  const bool is_relation =
      model_.has_phases() && expr.bindings[0].domain == nullptr && !model_.is_stated(*expr.operands[0]);
  if (!is_relation) model_.set_stated(expr);
  return {Type::Kind::boolean, false, 0, Known::by_solving, nullptr};
}

bool Checker::ranges_over_reals(const Expr& expr) const {
  return std::all_of(expr.bindings.begin(), expr.bindings.end(), [&](const Binding& bound) {
    return bound.domain != nullptr && (model_.time == nullptr || bound.name.text != model_.time->name.text);
  });
}

// forall(p in [a, b]) and exists(p in [a, b]).
Type Checker::check_over_reals(const Expr& expr) {
  const std::size_t outside = locals_.size();
  bool good = true;
  for (const Binding& bound : expr.bindings) {
    const Type domain = check(*bound.domain);
    if (!domain.is_error() && (!domain.is(Type::Kind::domain) || domain.tube || domain.is_array())) {
      diagnostics().report(Code::wrong_type, bound.domain->range, "a domain `[a, b]`", describe(domain));
      good = false;
    }
    good = good && !domain.is_error() && require_known(*bound.domain, domain);
    const Type number{Type::Kind::real, false, domain.dim, Known::by_solving, nullptr};
    model_.set_reference(*bound.domain, {nullptr, bind(bound.name.text, number), BuiltIn::none});
  }
  const Type body = good ? check(*expr.operands[0]) : Type{};
  locals_.resize(outside);
  if (body.is_error()) return {};
  if (!body.is(Type::Kind::boolean) || body.is_array()) {
    diagnostics().report(Code::wrong_type, expr.operands[0]->range, "a relation", describe(body));
    return {};
  }
  if (body.tube || model_.is_stated(*expr.operands[0]))
    return not_supported(expr.operands[0]->range, "this relation below a quantifier over reals");
  return {Type::Kind::boolean, false, 0, Known::by_solving, nullptr};
}

// union(t), inter(i in 1..n) and their like.
Type Checker::check_union(const Expr& expr, std::uint32_t dim) {
  const bool ranges = ranges_over_numbers(expr);
  if (ranges ? !bind_ranges(expr) : !binds_time(expr)) return {};
  if (!ranges && expr.bindings[0].domain != nullptr)
    return not_supported(expr.bindings[0].domain->range, "a union over a part of the time line");
  Type body = check_set(*expr.operands[0], dim);
  if (ranges) body = unbound(expr, body);
  if (body.is_error()) return {};
  if (!body.is(Type::Kind::set)) {
    diagnostics().report(Code::wrong_type, expr.operands[0]->range, "a set", describe(body));
    return {};
  }
  return {Type::Kind::set, ranges && body.tube, body.dim, Known::by_solving, nullptr};
}

Type Checker::check_minimum(const Expr& expr) {
  const Binding& bound = expr.bindings[0];
  const Type set = check(*bound.domain);
  if (set.is_error()) return {};
  if (!set.is(Type::Kind::set) || expr.bindings.size() > 1)
    return not_supported(expr.range, "`min` over a range");
  const std::uint32_t local =
      bind(bound.name.text, {Type::Kind::real, false, set.dim, Known::by_solving, nullptr});
  model_.set_reference(expr, {nullptr, local, BuiltIn::none});
  const Type body = check(*expr.operands[0]);
  locals_.pop_back();
  if (body.is_error()) return {};
  if (!body.is_scalar_real()) {
    diagnostics().report(Code::wrong_type, expr.operands[0]->range, "`real`", describe(body));
    return {};
  }
  if (!is_stated_side(expr))
    return not_supported(expr.range, "`min` over a set other than alone on one side of `==`");
  model_.set_stated(expr);
  return body;
}

Type Checker::check_distance(const Expr& expr) {
  const Type point = check(*expr.operands[1]);
  const Type set = check_set(*expr.operands[2], point.is(Type::Kind::real) ? point.dim : 0);
  if (point.is_error() || set.is_error()) return {};
  if (!point.is(Type::Kind::real) || point.dim == 0) {
    diagnostics().report(Code::wrong_type, expr.operands[1]->range, "a point", describe(point));
    return {};
  }
  if (!set.is(Type::Kind::set)) {
    diagnostics().report(Code::wrong_type, expr.operands[2]->range, "a set", describe(set));
    return {};
  }
  if (set.dim != point.dim) {
    diagnostics().report(Code::sizes_differ, expr.range, describe(point), describe(set));
    return {};
  }
  if (!is_stated_side(expr))
    return not_supported(expr.range, "`distance` other than alone on one side of `==`");
  model_.set_stated(expr);
  return {Type::Kind::real, point.tube, 0, Known::by_solving, nullptr};
}

bool Checker::require_sets(const Expr& expr, const Expr& a, const Expr& b) {
  const Type of_a = model_.type(a), of_b = model_.type(b);
  if (of_a.is_error() || of_b.is_error()) return false;
  for (const Expr* side : {&a, &b}) {
    const Type type = model_.type(*side);
    if (type.is(Type::Kind::set) && !type.is_array()) continue;
    diagnostics().report(Code::wrong_type, side->range, "a set", describe(type));
    return false;
  }
  if (of_a.dim == of_b.dim) return true;
  diagnostics().report(Code::sizes_differ, expr.range, describe(of_a), describe(of_b));
  return false;
}

Type Checker::check_set_relation(const Expr& expr, const Expr& a, const Expr& b) {
  if (!require_sets(expr, a, b)) return {};
  model_.set_stated(expr);
  return combined(Type::Kind::boolean, 0, model_.type(a), model_.type(b));
}

Type Checker::check_set_equality(const Expr& expr, const Type& a, const Type& b) {
  if (!require_sets(expr, *expr.operands[0], *expr.operands[1])) return {};
  if (a.tube || b.tube) {
    diagnostics().report(Code::zone_over_time, expr.operands[a.tube ? 0 : 1]->range, model_.time->name.text);
    return {};
  }
  model_.set_stated(expr);
  return {Type::Kind::boolean, false, 0, Known::by_solving, nullptr};
}

Type Checker::check_set_operation(const Expr& expr, const Type& a, const Type& b) {
  if (!a.is(Type::Kind::set) && !b.is(Type::Kind::set)) return wrong_operands(expr, a, b);
  if (!require_sets(expr, *expr.operands[0], *expr.operands[1])) return {};
  return combined(Type::Kind::set, a.dim, a, b);
}

Type Checker::check_complement(const Expr& expr, std::uint32_t dim) {
  const Expr& written = *expr.operands[1];
  const Type set = check_set(written, dim);
  model_.set_reference(*expr.operands[0], {nullptr, Reference::kNoLocal, BuiltIn::complement});
  if (set.is_error() || (set.is(Type::Kind::set) && !set.is_array())) return set;
  diagnostics().report(Code::wrong_type, written.range, "a set", describe(set));
  return {};
}

// Of a set builder its relation at the point is meant, which is an expression.
Type Checker::check_point_in_set(const Expr& expr, const Type& point, const Type& set) {
  if (!point.is(Type::Kind::real) || point.is_array() || point.is_matrix() || set.is_array())
    return wrong_operands(expr, point, set);
  if (std::max(point.dim, 1U) != set.dim) {
    diagnostics().report(Code::sizes_differ, expr.range, describe(point), describe(set));
    return {};
  }
  if (model_.unfold(*expr.operands[1]).kind != ExprKind::builder) model_.set_stated(expr);
  return combined(Type::Kind::boolean, 0, point, set);
}

}  // namespace hcsp::lang
