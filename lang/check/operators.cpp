// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "lang/check/checker.h"

namespace hcsp::lang {

namespace {

/// The product of matrices and vectors; a vector is a row on the left and a column on the right.
std::optional<Type> type_of_product(const Type& a, const Type& b) {
  Type type = combined(Type::Kind::real, 0, a, b);
  if (a.is_matrix() && b.is_matrix() && a.columns == b.dim) {
    type.dim = a.dim;
    type.columns = b.columns;
    return type;
  }
  if (a.is_matrix() && b.is_vector() && a.columns == b.dim) {
    type.dim = a.dim;
    return type;
  }
  if (a.is_vector() && b.is_matrix() && a.dim == b.dim) {
    type.dim = b.columns;
    return type;
  }
  return {};
}

/// None where the operator does not apply.
std::optional<Type> type_of_arithmetic(Operator op, const Type& a, const Type& b) {
  if (a.is_array() || b.is_array()) return {};
  switch (op) {
    case Operator::multiply:
      if (a.is_scalar()) return combined_as(b, a, b);
      return b.is_scalar() ? combined_as(a, a, b) : type_of_product(a, b);
    case Operator::divide: {
      if (!b.is_scalar()) return {};
      Type type = combined_as(a, a, b);
      type.whole = false;
      return type;
    }
    default:
      return a.has_shape_of(b) ? std::optional(combined_as(a, a, b)) : std::nullopt;
  }
}

}  // namespace

Type Checker::wrong_operands(const Expr& expr, const Type& a, const Type& b) {
  diagnostics().report(Code::wrong_operands, expr.token, spelling(expr.op), describe(a), describe(b));
  return {};
}

Type Checker::domain_in_expression(const Expr& expr) {
  auto& diagnostic = diagnostics().report(Code::domain_in_expression, expr.range);
  if (expr.kind != ExprKind::binary || expr.op != Operator::equal) return {};
  const bool right = model_.type(*expr.operands[1]).is(Type::Kind::domain);
  const std::string_view value = expr.operands[right ? 0 : 1]->range.text();
  const std::string_view domain = expr.operands[right ? 1 : 0]->range.text();
  if (value.size() + domain.size() < 80) diagnostic.note(fmt::format("write `{} in {}`", value, domain));
  return {};
}

Type Checker::check_unary(const Expr& expr) {
  const Type a = check(*expr.operands[0]);
  if (a.is_error()) return {};
  if (expr.op == Operator::logical_not) {
    if (!a.is(Type::Kind::boolean)) return wrong_operands(expr, a, a);
    if (a.tube && !pointwise_) {
      diagnostics().report(Code::logic_over_time, expr.token, spelling(expr.op));
      return {};
    }
    return a;
  }
  if (a.is(Type::Kind::domain)) return domain_in_expression(expr);
  if ((a.is(Type::Kind::real) && !a.is_array()) || a.is(Type::Kind::column)) return a;
  diagnostics().report(Code::wrong_type, expr.operands[0]->range, "a number", describe(a));
  return {};
}

Type Checker::check_binary(const Expr& expr) {
  if (std::exchange(stated_, nullptr) == &expr && expr.op == Operator::equal) {
    sides_ = {expr.operands[0], expr.operands[1]};
  }
  // The operands of a relation are taken at one instant.
  const bool pointwise = std::exchange(pointwise_, pointwise_ || !is_logical(expr.op));
  const auto [a, b] = check_pair(*expr.operands[0], *expr.operands[1]);
  pointwise_ = pointwise;
  if (a.is_error() || b.is_error()) return {};
  if (is_logical(expr.op)) return check_logic(expr, a, b);
  if (is_comparison(expr.op)) return check_comparison(expr, a, b);
  switch (expr.op) {
    case Operator::in:
      return check_membership(expr, a, b);
    case Operator::plus_minus:
      return check_tolerance(expr, a, b);
    case Operator::power:
      return check_power(expr, a, b);
    case Operator::range:
      return check_range(expr, a, b);
    case Operator::subset:
    case Operator::set_union:
    case Operator::set_symdiff:
    case Operator::set_minus:
    case Operator::set_inter:
      return not_supported(expr.token, fmt::format("`{}`", spelling(expr.op)));
    default:
      return check_arithmetic(expr, a, b);
  }
}

Type Checker::check_arithmetic(const Expr& expr, const Type& a, const Type& b) {
  if (a.is(Type::Kind::domain) || b.is(Type::Kind::domain)) return domain_in_expression(expr);
  const bool columns = a.is(Type::Kind::column) || b.is(Type::Kind::column);
  const auto is_operand = [](const Type& t) { return t.is(Type::Kind::real) || t.is(Type::Kind::column); };
  if (!is_operand(a) || !is_operand(b)) return wrong_operands(expr, a, b);
  if (columns && a.known != Known::now && b.known != Known::now) return wrong_operands(expr, a, b);
  const auto made = type_of_arithmetic(expr.op, a, b);
  if (!made) return wrong_operands(expr, a, b);
  if (!columns) return *made;
  if (a.known != Known::now || b.known != Known::now) {
    diagnostics().report(Code::not_constant, expr.operands[a.known == Known::now ? 1 : 0]->range);
    return {};
  }
  if (a.data != nullptr && b.data != nullptr && a.data != b.data) {
    diagnostics().report(Code::rows_differ, expr.range, a.data->name.text, b.data->name.text);
    return {};
  }
  Type type = combined(Type::Kind::column, made->dim, a, b);
  type.data = a.data != nullptr ? a.data : b.data;
  return type;
}

Type Checker::check_power(const Expr& expr, const Type& base, const Type& exponent) {
  const Expr& written = *expr.operands[1];
  if (base.is(Type::Kind::domain)) {
    if (!base.is_scalar() || base.tube) return wrong_operands(expr, base, exponent);
    const auto count = size_of(written);
    return count ? Type{Type::Kind::domain, false, *count, base.known, nullptr} : Type{};
  }
  if (!base.is_scalar_real() || !exponent.is_scalar_real()) return wrong_operands(expr, base, exponent);
  Type type = combined(Type::Kind::real, 0, base, exponent);
  type.whole = base.whole && exponent.whole;
  return type;
}

Type Checker::check_tolerance(const Expr& expr, const Type& a, const Type& b) {
  const bool centre = a.is(Type::Kind::real) || (a.is(Type::Kind::domain) && a.tube);
  const bool error = (b.is(Type::Kind::real) && !b.tube) || b.is(Type::Kind::column);
  if (!centre || !error) return wrong_operands(expr, a, b);
  if (b.dim != 0 && b.dim != a.dim) {
    diagnostics().report(Code::sizes_differ, expr.range, describe(a), describe(b));
    return {};
  }
  if (b.is(Type::Kind::column) && a.data != b.data) {
    diagnostics().report(Code::rows_differ, expr.range, a.data == nullptr ? "the value" : a.data->name.text,
                         b.data->name.text);
    return {};
  }
  Type type = combined(Type::Kind::domain, a.dim, a, b);
  type.data = a.data;
  return type;
}

Type Checker::check_comparison(const Expr& expr, const Type& a, const Type& b) {
  if (a.is(Type::Kind::domain) || b.is(Type::Kind::domain)) return domain_in_expression(expr);
  const bool truths =
      a.is(Type::Kind::boolean) && b.is(Type::Kind::boolean) && !a.is_array() && !b.is_array();
  if (truths && (expr.op == Operator::equal || expr.op == Operator::not_equal))
    return check_logic(expr, a, b);
  const bool sets = a.is(Type::Kind::set) && b.is(Type::Kind::set) && expr.op == Operator::equal;
  if (!sets && (!a.is(Type::Kind::real) || !b.is(Type::Kind::real))) return wrong_operands(expr, a, b);
  if (!a.has_shape_of(b)) {
    diagnostics().report(Code::sizes_differ, expr.range, describe(a), describe(b));
    return {};
  }
  if (sets && (a.tube || b.tube)) {
    diagnostics().report(Code::zone_over_time, expr.operands[a.tube ? 0 : 1]->range, model_.time->name.text);
    return {};
  }
  return combined(Type::Kind::boolean, 0, a, b);
}

Type Checker::check_membership(const Expr& expr, const Type& a, const Type& b) {
  if (b.is(Type::Kind::set)) return not_supported(expr.token, "a point in a set");
  if (!a.is(Type::Kind::real) || !b.is(Type::Kind::domain)) return wrong_operands(expr, a, b);
  if (a.dim != b.dim) {
    diagnostics().report(Code::sizes_differ, expr.range, describe(a), describe(b));
    return {};
  }
  if (b.data != nullptr) return not_supported(expr.operands[1]->range, "data as a domain within a relation");
  return combined(Type::Kind::boolean, 0, a, b);
}

Type Checker::check_logic(const Expr& expr, const Type& a, const Type& b) {
  if (!a.is(Type::Kind::boolean) || !b.is(Type::Kind::boolean)) return wrong_operands(expr, a, b);
  if (expr.op != Operator::logical_and && (a.tube || b.tube) && !pointwise_) {
    diagnostics().report(Code::logic_over_time, expr.token, spelling(expr.op));
    return {};
  }
  return combined(Type::Kind::boolean, 0, a, b);
}

}  // namespace hcsp::lang
