// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "lang/check/checker.h"
#include "lang/syntax/parser.h"

namespace hcsp::lang {

namespace {
// Definitions that use each other are followed to this depth; the stack holds several frames a level.
constexpr std::uint32_t kDeepestCheck = 2000;
}  // namespace

Type Checker::check(const Expr& expr) {
  if (depth_ >= kDeepestCheck) {
    diagnostics().report(Code::too_deep, expr.range, kDeepestNesting, kDeepestTree);
    return {};
  }
  ++depth_;
  const Type type = check_kind(expr);
  --depth_;
  model_.set_type(expr, type);
  return type;
}

Type Checker::check_kind(const Expr& expr) {
  const Type number{Type::Kind::real, false, 0, Known::now, nullptr};
  switch (expr.kind) {
    case ExprKind::number: {
      const auto written = Number::parse(expr.text);
      if (written && !written->enclosure.is_bounded())
        diagnostics().report(Code::out_of_range, expr.range, "no double is as large");
      return number;
    }
    case ExprKind::string:
      return {Type::Kind::text, false, 0, Known::now, nullptr};
    case ExprKind::boolean:
      return {Type::Kind::boolean, false, 0, Known::now, nullptr};
    case ExprKind::infinity:
      diagnostics().report(Code::misplaced_infinity, expr.range);
      return {};
    case ExprKind::name:
      return check_name(expr);
    case ExprKind::member:
      return check_member(expr);
    case ExprKind::index:
      return check_index(expr);
    case ExprKind::call:
      return check_call(expr);
    case ExprKind::unary:
      return check_unary(expr);
    case ExprKind::binary:
      return check_binary(expr);
    case ExprKind::tuple:
      return check_tuple(expr);
    case ExprKind::interval:
      return check_interval(expr);
    case ExprKind::builder:
      return check_builder(expr, 0);
    case ExprKind::quantified:
      return check_quantified(expr, 0);
    case ExprKind::conditional:
      return check_conditional(expr);
    case ExprKind::comprehension:
      return check_comprehension(expr);
  }
  return {};
}

Type Checker::check_name(const Expr& expr) {
  for (auto local = locals_.rbegin(); local != locals_.rend(); ++local) {
    if (local->name != expr.text) continue;
    model_.set_reference(expr, {nullptr, local->id, BuiltIn::none});
    return local->type;
  }
  const auto found = model_.by_name.find(expr.text);
  if (found != model_.by_name.end()) {
    Symbol& symbol = *found->second;
    model_.set_reference(expr, {&symbol, Reference::kNoLocal, BuiltIn::none});
    ensure(symbol);
    if (symbol.as<FunctionItem>() != nullptr) {
      diagnostics().report(Code::wrong_type, expr.range, "a value", "a function").note("call it");
      return {};
    }
    if (symbol.as<ConstraintItem>() != nullptr) {
      diagnostics().report(Code::wrong_type, expr.range, "a value", "the name of a constraint");
      return {};
    }
    const auto* let = symbol.as<LetItem>();
    if (let != nullptr && model_.is_stated(*let->value)) model_.set_stated(expr);
    if (symbol.takes_instants) ++instants_to_find_;
    return symbol.type;
  }
  if (expr.text == "pi") return {Type::Kind::real, false, 0, Known::now, nullptr};
  if (find_built_in(expr.text) != nullptr) {
    diagnostics().report(Code::wrong_type, expr.range, "a value", "a function").note("call it");
    return {};
  }
  diagnostics().report(Code::unknown_name, expr.range, expr.text).did_you_mean(expr.text, visible_names());
  return {};
}

Type Checker::check_member(const Expr& expr) {
  const Type base = check(*expr.operands[0]);
  if (base.is_error()) return {};
  if (!base.is(Type::Kind::table)) {
    diagnostics().report(Code::wrong_type, expr.operands[0]->range, "a table of data", describe(base));
    return {};
  }
  const Table& table = *base.data->table;
  const auto& columns = table.columns();
  if (std::find(columns.begin(), columns.end(), expr.text) == columns.end()) {
    auto& diagnostic =
        diagnostics().report(Code::unknown_column, expr.token, table.source().name(), expr.text);
    diagnostic.did_you_mean(expr.text, columns);
    std::string list;
    for (std::size_t i = 0; i < std::min<std::size_t>(columns.size(), 20); ++i) {
      list += fmt::format("{}{}", i == 0 ? "" : ", ", columns[i]);
    }
    diagnostic.note(fmt::format("its columns are {}{}", list, columns.size() > 20 ? ", ..." : ""));
    return {};
  }
  return {Type::Kind::column, false, 0, Known::now, base.data};
}

Type Checker::check_index(const Expr& expr) {
  Type base = check(*expr.operands[0]);
  bool bad = base.is_error();
  const bool is_column = base.is(Type::Kind::column) && base.dim == 0;
  const bool has_components =
      base.is_array() || (base.dim != 0 && base.is(Type::Kind::real)) || is_column || bad;
  if (!has_components) {
    diagnostics().report(Code::no_components, expr.operands[0]->range, describe(base));
    bad = true;
  }
  const std::size_t most = is_column ? 1 : base.sizes().size();
  if (!bad && expr.operands.size() - 1 > most) {
    diagnostics().report(Code::wrong_argument_count, expr.range, "[]",
                         most == 1 ? "1 index" : fmt::format("at most {} indices", most),
                         expr.operands.size() - 1);
    bad = true;
  }
  for (std::size_t i = 1; i < expr.operands.size(); ++i) {
    const Expr& written = *expr.operands[i];
    const Type index = check(written);
    if (index.is_error() || bad) {
      bad = true;
    } else {
      bad = !require_scalar(written, index) || !require_known(written, index) || !check_place(written, base);
      base = component_of(base);
      base.known = std::min(base.known, index.known);
    }
  }
  return bad ? Type{} : base;
}

// A number is looked at now; any other index when its value is wanted (evaluate), for it may stand under a
// condition on constants that keeps it inside.
bool Checker::check_place(const Expr& written, const Type& base) {
  if (written.kind != ExprKind::number) return true;
  const auto place = constants_.whole(written);
  return place && require_index(base, *place, written.range, diagnostics());
}

Type Checker::check_tuple(const Expr& expr) {
  Type type{Type::Kind::real, false, static_cast<std::uint32_t>(expr.operands.size()), Known::now, nullptr};
  std::size_t columns = 0;
  bool bad = false;
  const Expr* first = nullptr;                      // that is no error
  const Expr *data = nullptr, *computed = nullptr;  // domains of tubes, of two kinds
  for (const Expr* operand : expr.operands) {
    const Type component = check(*operand);
    if (component.is_error()) {
      bad = true;
      continue;
    }
    const bool is_column = component.is(Type::Kind::column);
    const bool is_value = component.is(Type::Kind::real) || component.is(Type::Kind::domain);
    if (!(is_column && component.dim == 0) &&
        !(is_value && (component.is_scalar() || component.is_vector()))) {
      diagnostics().report(Code::wrong_type, operand->range, "a number or a vector", describe(component));
      bad = true;
      continue;
    }
    // Vectors are the rows of a matrix.
    if (first == nullptr) {
      first = operand;
      type.columns = component.dim;
    }
    if (component.dim != type.columns) {
      diagnostics().report(Code::sizes_differ, operand->range, describe(model_.type(*first)),
                           describe(component));
      bad = true;
    }
    if (is_column && type.data != nullptr && type.data != component.data) {
      diagnostics().report(Code::rows_differ, operand->range, type.data->name.text,
                           component.data->name.text);
      bad = true;
    }
    columns += is_column ? 1 : 0;
    if (component.is(Type::Kind::domain)) type.kind = Type::Kind::domain;
    if (component.tube) (component.known == Known::now ? data : computed) = operand;
    if (is_column) type.data = component.data;
    type.tube = type.tube || component.tube;
    type.known = std::min(type.known, component.known);
  }
  if (bad) return {};
  if (type.is(Type::Kind::domain) && data != nullptr && computed != nullptr)
    return not_supported(computed->range, "what is computed from the time beside data");
  if (columns == 0) return type;
  if (columns != expr.operands.size()) {
    diagnostics().report(Code::wrong_type, expr.range, "columns only", "columns beside numbers");
    return {};
  }
  type.kind = Type::Kind::column;
  return type;
}

Type Checker::check_interval(const Expr& expr) {
  Type type{Type::Kind::domain, false, 0, Known::now, nullptr};
  bool bad = false;
  for (const Expr* bound : expr.operands) {
    const bool negated = bound->kind == ExprKind::unary && bound->op == Operator::negate;
    const Expr& inner = negated ? *bound->operands[0] : *bound;
    if (inner.kind == ExprKind::infinity) {
      const bool fits = negated == (bound == expr.operands[0]);
      if (!fits) diagnostics().report(Code::misplaced_infinity, bound->range);
      bad = bad || !fits;
      continue;
    }
    const Type found = check(*bound);
    if (!found.is_error() && !found.is_scalar_real()) {
      diagnostics().report(Code::wrong_type, bound->range, "a number", describe(found));
    }
    bad = bad || !found.is_scalar_real();
    type.tube = type.tube || found.tube;
    type.known = std::min(type.known, found.known);
  }
  return bad ? Type{} : type;
}

Type Checker::check_conditional(const Expr& expr) {
  // Of a choice between numbers the condition is taken at one instant; which it is takes a look at them.
  const std::uint32_t instants_before = instants_to_find_;
  const Type then = check(*expr.operands[1]);
  const Type otherwise = check(*expr.operands[2]);
  const bool at_instants = instants_to_find_ != instants_before;
  const bool pointwise = std::exchange(pointwise_, pointwise_ || !then.is(Type::Kind::boolean));
  const Type condition = check(*expr.operands[0]);
  pointwise_ = pointwise;
  if (condition.is_error() || then.is_error() || otherwise.is_error()) return {};
  if (!condition.is(Type::Kind::boolean)) {
    diagnostics().report(Code::wrong_type, expr.operands[0]->range, "a relation", describe(condition));
    return {};
  }
  const bool fits =
      then.kind == otherwise.kind && (then.is(Type::Kind::real) || then.is(Type::Kind::boolean));
  if (!fits) {
    diagnostics().report(Code::wrong_type, expr.operands[2]->range, describe(then), describe(otherwise));
    return {};
  }
  if (!then.has_shape_of(otherwise)) {
    diagnostics().report(Code::sizes_differ, expr.range, describe(then), describe(otherwise));
    return {};
  }
  Type type = combined_as(then, then, otherwise);
  type.tube = type.tube || condition.tube;
  type.known = std::min(type.known, condition.known);
  if (type.is(Type::Kind::boolean)) {
    lift(expr, type, false);
  } else if (at_instants) {
    // What is not chosen need not exist, but a tube at an instant to be found is stated to.
    return not_supported(expr.range, "a choice between tubes at instants to be found");
  } else if (model_.is_stated(*expr.operands[0]) && condition.tube) {
    return not_supported(expr.operands[0]->range, "this relation as the condition of a number");
  }
  return type;
}

}  // namespace hcsp::lang
