// SPDX-License-Identifier: Apache-2.0
// What ranges over whole numbers: `forall(i in 1..n)` and its like, and comprehensions. Bodies are checked
// once; they are put in place for every value when the model is compiled (evaluate/ranges.cpp).
#include "lang/check/checker.h"

namespace hcsp::lang {

Type Checker::check_range(const Expr& expr, const Type& a, const Type& b) {
  for (const auto& [bound, type] : {std::pair(expr.operands[0], &a), std::pair(expr.operands[1], &b)}) {
    if (!require_scalar(*bound, *type) || !require_known(*bound, *type)) return {};
  }
  return {Type::Kind::range, false, 0, std::min(a.known, b.known), nullptr};
}

// The names are in sight until unbound(); false after a report, with nothing bound.
bool Checker::bind_ranges(const Expr& expr) {
  const std::size_t outside = locals_.size();
  for (const Binding& binding : expr.bindings) {
    if (check(*binding.domain).is_error()) {
      locals_.resize(outside);
      return false;
    }
    Type number{Type::Kind::real, false, 0, Known::when_bound, nullptr};
    number.whole = true;
    model_.set_reference(*binding.domain, {nullptr, bind(binding.name.text, number), BuiltIn::none});
  }
  ++ranges_;
  return true;
}

// The type of what stands on a body of this type once the names have gone.
Type Checker::unbound(const Expr& expr, Type type) {
  locals_.resize(locals_.size() - expr.bindings.size());
  --ranges_;
  for (const Binding& binding : expr.bindings)
    type.known = std::min(type.known, model_.type(*binding.domain).known);
  if (type.known == Known::when_bound && ranges_ == 0) type.known = Known::now;
  return type;
}

Type Checker::check_over_range(const Expr& expr) {
  const Expr& written = *expr.operands[0];
  const bool counts = expr.quantifier == Quantifier::at_least;
  if (counts) {
    const Type count = check(*expr.operands[1]);
    if (count.is_error() || !require_scalar(*expr.operands[1], count) ||
        !require_known(*expr.operands[1], count))
      return {};
  }
  if (!bind_ranges(expr)) return {};
  const bool is_relation =
      expr.quantifier == Quantifier::forall || expr.quantifier == Quantifier::exists || counts;
  Type body = unbound(expr, check(written));
  if (body.is_error()) return {};
  if (is_relation) {
    if (!body.is(Type::Kind::boolean) || body.is_array()) {
      diagnostics().report(Code::wrong_type, written.range, "a relation", describe(body));
      return {};
    }
    lift(expr, body, expr.quantifier == Quantifier::forall);
    return body;
  }
  const bool adds = expr.quantifier == Quantifier::sum;
  if (!body.is(Type::Kind::real) || body.is_array() || (!adds && !body.is_scalar())) {
    diagnostics().report(Code::wrong_type, written.range, adds ? "a number, a vector or a matrix" : "`real`",
                         describe(body));
    return {};
  }
  return body;
}

// atleast(k, (c1, ..., cn)).
Type Checker::check_at_least(const Expr& expr) {
  const Expr &count = *expr.operands[1], &list = *expr.operands[2];
  const Type type_of_count = check(count);
  if (type_of_count.is_error() || !require_scalar(count, type_of_count) ||
      !require_known(count, type_of_count))
    return {};
  if (list.kind != ExprKind::tuple) {
    diagnostics().report(Code::wrong_type, list.range, "a list of relations `(c1, ..., cn)`",
                         fmt::format("`{}`", list.range.text().substr(0, 40)));
    return {};
  }
  Type all{Type::Kind::boolean, false, 0, type_of_count.known, nullptr};
  bool bad = false;
  for (const Expr* relation : list.operands) {
    const Type type = check(*relation);
    bad = bad || type.is_error();
    if (!type.is_error() && (!type.is(Type::Kind::boolean) || type.is_array())) {
      diagnostics().report(Code::wrong_type, relation->range, "a relation", describe(type));
      bad = true;
    }
    all = combined(Type::Kind::boolean, 0, all, type);
  }
  if (bad) return {};
  if (std::any_of(list.operands.begin(), list.operands.end(),
                  [&](const Expr* relation) { return model_.is_stated(*relation); }))
    model_.set_stated(list);
  lift(expr, all, false);
  return all;
}

Type Checker::check_comprehension(const Expr& expr) {
  std::size_t size = 1;
  for (const Binding& binding : expr.bindings) {
    if (is_whole_range(binding)) continue;
    diagnostics().report(Code::wrong_type, binding.name.range, "a range of whole numbers",
                         binding.domain == nullptr
                             ? std::string("a name alone")
                             : fmt::format("`{}`", binding.domain->range.text().substr(0, 40)));
    return {};
  }
  if (!bind_ranges(expr)) return {};
  Type type = unbound(expr, check(*expr.operands[0]));
  if (type.is_error()) return {};
  if (!type.is(Type::Kind::real) || !(type.is_scalar() || type.is_vector())) {
    diagnostics().report(Code::wrong_type, expr.operands[0]->range, "a number or a vector", describe(type));
    return {};
  }
  for (const Binding& binding : expr.bindings) {
    const auto extent = extent_of(*binding.domain);
    if (!extent) return {};
    size *= extent->size();
    if (size <= kMostComponents) continue;
    diagnostics().report(Code::bad_size, expr.range, kMostComponents, size);
    return {};
  }
  type.columns = type.dim;
  type.dim = static_cast<std::uint32_t>(size);
  type.whole = false;
  return type;
}

}  // namespace hcsp::lang
