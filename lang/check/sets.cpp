// SPDX-License-Identifier: Apache-2.0
#include "lang/check/checker.h"

namespace hcsp::lang {

namespace {

// Whether an expression is a set builder, or a union of one, that does not say its dimension.
bool wants_dimension(const Expr& expr) {
  if (expr.kind == ExprKind::builder) return expr.bindings[0].type == nullptr;
  return expr.kind == ExprKind::quantified && expr.quantifier == Quantifier::set_union &&
         wants_dimension(*expr.operands[0]);
}

std::uint32_t dimension_of(const Type& type) { return type.is(Type::Kind::set) ? type.dim : 0; }

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
  Type type;
  if (expr.kind == ExprKind::builder) {
    type = check_builder(expr, dim);
  } else if (expr.kind == ExprKind::quantified) {
    type = check_quantified(expr, dim);
  } else {
    return check(expr);
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

bool Checker::binds_time(const Expr& expr) {
  const Binding& bound = expr.bindings[0];
  if (expr.bindings.size() > 1 || bound.domain != nullptr) {
    not_supported(bound.name.range,
                  fmt::format("`{}` over anything but all of the time line", spelling(expr.quantifier)));
    return false;
  }
  if (model_.time != nullptr && bound.name.text == model_.time->name.text) return true;
  auto& diagnostic = diagnostics().report(Code::not_the_time, bound.name.range, bound.name.text);
  if (model_.time != nullptr) diagnostic.note(fmt::format("the time line is `{}`", model_.time->name.text));
  return false;
}

Type Checker::check_quantified(const Expr& expr, std::uint32_t dim) {
  const bool stated = std::exchange(stated_, nullptr) == &expr;
  const bool is_set = expr.quantifier == Quantifier::set_union || expr.quantifier == Quantifier::set_inter;
  if (!is_set && ranges_over_numbers(expr)) return check_over_range(expr, stated);
  switch (expr.quantifier) {
    case Quantifier::forall: {
      if (!binds_time(expr)) return {};
      const bool pointwise = std::exchange(pointwise_, true);
      const Type body = stated ? check_stated(*expr.operands[0]) : check(*expr.operands[0]);
      pointwise_ = pointwise;
      if (body.is_error()) return {};
      if (!body.is(Type::Kind::boolean)) {
        diagnostics().report(Code::wrong_type, expr.operands[0]->range, "a relation", describe(body));
        return {};
      }
      if (!stated) return not_supported(expr.range, "`forall` within a relation");
      return {Type::Kind::boolean, false, 0, Known::by_solving, nullptr};
    }
    case Quantifier::set_union: {
      if (!binds_time(expr)) return {};
      const Type body = check_set(*expr.operands[0], dim);
      if (body.is_error()) return {};
      if (!body.is(Type::Kind::set)) {
        diagnostics().report(Code::wrong_type, expr.operands[0]->range, "a set", describe(body));
        return {};
      }
      return {Type::Kind::set, false, body.dim, Known::by_solving, nullptr};
    }
    case Quantifier::minimum:
      return check_minimum(expr);
    default:
      return not_supported(expr.range, fmt::format("`{}` with bound names", spelling(expr.quantifier)));
  }
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
  return {Type::Kind::real, point.tube, 0, Known::by_solving, nullptr};
}

Type Checker::check_set_relation(const Expr& expr, const BuiltInFunction& function) {
  const bool stated = std::exchange(stated_, nullptr) == &expr;
  const auto [a, b] = check_pair(*expr.operands[1], *expr.operands[2]);
  if (a.is_error() || b.is_error()) return {};
  for (std::size_t i = 0; i < 2; ++i) {
    const Type& type = i == 0 ? a : b;
    if (type.is(Type::Kind::set)) continue;
    diagnostics().report(Code::wrong_type, expr.operands[i + 1]->range, "a set", describe(type));
    return {};
  }
  if (a.dim != b.dim) {
    diagnostics().report(Code::sizes_differ, expr.range, describe(a), describe(b));
    return {};
  }
  if (!stated) return not_supported(expr.range, fmt::format("`{}` within a relation", function.name));
  return {Type::Kind::boolean, false, 0, Known::by_solving, nullptr};
}

Type Checker::check_stated(const Expr& expr) {
  if (expr.kind == ExprKind::binary && expr.op == Operator::logical_and) {
    const Type a = check_stated(*expr.operands[0]);
    const Type b = check_stated(*expr.operands[1]);
    const Type type = a.is_error() || b.is_error() ? Type{} : check_logic(expr, a, b);
    model_.set_type(expr, type);
    return type;
  }
  stated_ = &expr;
  const Type type = check(expr);
  stated_ = nullptr;
  return type;
}

}  // namespace hcsp::lang
