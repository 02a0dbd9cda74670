// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "lang/check/checker.h"

namespace hcsp::lang {

namespace {

bool is_relation(BuiltIn function) {
  return function == BuiltIn::at_least || function == BuiltIn::disjoint || function == BuiltIn::meets ||
         function == BuiltIn::subset;
}

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
    return check_logic(expr, a, a);
  }
  if (a.is(Type::Kind::domain)) return domain_in_expression(expr);
  if ((a.is(Type::Kind::real) && !a.is_array()) || a.is(Type::Kind::column)) return a;
  diagnostics().report(Code::wrong_type, expr.operands[0]->range, "a number", describe(a));
  return {};
}

// Whether an equality is one between truths, which `iff` is too. The sides are not checked yet: how they are
// depends on it.
bool Checker::compares_truths(const Expr& expr) {
  if (expr.op != Operator::equal && expr.op != Operator::not_equal) return false;
  return std::any_of(expr.operands.begin(), expr.operands.end(),
                     [&](const Expr* side) { return is_truth(*side); });
}

bool Checker::is_truth(const Expr& expr) {
  switch (expr.kind) {
    case ExprKind::boolean:
      return true;
    case ExprKind::unary:
    case ExprKind::binary:
      return is_logical(expr.op) || is_comparison(expr.op) || expr.op == Operator::in ||
             expr.op == Operator::subset;
    case ExprKind::quantified:
      return expr.quantifier <= Quantifier::at_least;
    case ExprKind::conditional:
      return is_truth(*expr.operands[1]);
    case ExprKind::index:
    case ExprKind::call:
      return is_truth(*expr.operands[0]);
    case ExprKind::name:
      return names_truth(expr.text);
    default:
      return false;
  }
}

// Of functions and arrays: whether their values are truths.
bool Checker::names_truth(std::string_view name) {
  for (auto local = locals_.rbegin(); local != locals_.rend(); ++local) {
    if (local->name == name) return local->type.is(Type::Kind::boolean);
  }
  if (const BuiltInFunction* function = find_built_in(name)) return is_relation(function->id);
  const auto found = model_.by_name.find(name);
  if (found == model_.by_name.end()) return false;
  ensure(*found->second);
  return found->second->type.is(Type::Kind::boolean);
}

Type Checker::check_binary(const Expr& expr) {
  const std::size_t outer_sides = sides_.size();
  if (expr.op == Operator::equal) sides_.insert(sides_.end(), expr.operands.begin(), expr.operands.end());
  // The operands of a relation are taken at one instant.
  const std::uint32_t instants_before = instants_to_find_;
  const bool connects = is_logical(expr.op) || compares_truths(expr);
  const bool pointwise = std::exchange(pointwise_, pointwise_ || !connects);
  const auto [a, b] = check_pair(*expr.operands[0], *expr.operands[1]);
  pointwise_ = pointwise;
  sides_.resize(outer_sides);
  if ((is_comparison(expr.op) || expr.op == Operator::in) && instants_to_find_ != instants_before)
    model_.set_stated(expr);
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
      return check_set_relation(expr, *expr.operands[0], *expr.operands[1]);
    case Operator::set_union:
    case Operator::set_symdiff:
    case Operator::set_minus:
    case Operator::set_inter:
      return check_set_operation(expr, a, b);
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
  return combined(Type::Kind::real, 0, base, exponent);  // no int: n^-1 is not whole
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
  if (a.is(Type::Kind::set) && b.is(Type::Kind::set) &&
      (expr.op == Operator::equal || expr.op == Operator::not_equal)) {
    return check_set_equality(expr, a, b);
  }
  if (!a.is(Type::Kind::real) || !b.is(Type::Kind::real)) return wrong_operands(expr, a, b);
  if (!a.has_shape_of(b)) {
    diagnostics().report(Code::sizes_differ, expr.range, describe(a), describe(b));
    return {};
  }
  if (std::any_of(expr.operands.begin(), expr.operands.end(),
                  [&](const Expr* side) { return model_.is_stated(*side); }))
    model_.set_stated(expr);
  return combined(Type::Kind::boolean, 0, a, b);
}

Type Checker::check_membership(const Expr& expr, const Type& a, const Type& b) {
  if (b.is(Type::Kind::set)) return check_point_in_set(expr, a, b);
  if (!a.is(Type::Kind::real) || !b.is(Type::Kind::domain)) return wrong_operands(expr, a, b);
  if (a.dim != b.dim) {
    diagnostics().report(Code::sizes_differ, expr.range, describe(a), describe(b));
    return {};
  }
  if (b.data != nullptr) return not_supported(expr.operands[1]->range, "data as a domain within a relation");
  return combined(Type::Kind::boolean, 0, a, b);
}

// Outside what holds at one instant a relation that varies with time is one truth: it holds at every instant.
Type Checker::check_logic(const Expr& expr, const Type& a, const Type& b) {
  if (!a.is(Type::Kind::boolean) || !b.is(Type::Kind::boolean)) return wrong_operands(expr, a, b);
  Type type = combined(Type::Kind::boolean, 0, a, b);
  lift(expr, type, expr.op == Operator::logical_and);
  return type;
}

// A conjunction of what holds at every instant holds at every instant; any other connective of such truths is
// to be stated, as is one of what is.
void Checker::lift(const Expr& expr, Type& type, bool conjunction) {
  const bool of_truths = type.tube && !pointwise_ && !conjunction;
  const bool of_stated = std::any_of(expr.operands.begin(), expr.operands.end(),
                                     [&](const Expr* operand) { return model_.is_stated(*operand); });
  if (of_truths && model_.has_phases()) {
    type.tube = false;
    if (of_stated) model_.set_stated(expr);
    return;
  }
  if (type.tube && !conjunction && model_.has_phases()) {
    type = not_supported(expr.range, "a choice at every instant on a time line with phases");
    return;
  }
  if (of_truths || of_stated) model_.set_stated(expr);
  if (of_truths) type.tube = false;
}

}  // namespace hcsp::lang
