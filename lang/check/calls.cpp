// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "lang/check/checker.h"

namespace hcsp::lang {

Type Checker::check_call(const Expr& expr) {
  const Expr& callee = *expr.operands[0];
  const bool is_name = callee.kind == ExprKind::name;
  const bool is_local = is_name && std::any_of(locals_.begin(), locals_.end(), [&](const Visible& local) {
                          return local.name == callee.text;
                        });
  if (is_name && !is_local) {
    const auto found = model_.by_name.find(callee.text);
    Symbol* symbol = found == model_.by_name.end() ? nullptr : found->second;
    if (symbol != nullptr && symbol->as<FunctionItem>() != nullptr) {
      model_.set_reference(callee, {symbol, Reference::kNoLocal, BuiltIn::none});
      ensure(*symbol);
      return check_function_call(expr, *symbol);
    }
    if (symbol != nullptr) ensure(*symbol);
    // A table called `log` leaves the logarithm its name.
    const BuiltInFunction* built_in = find_built_in(callee.text);
    if (built_in != nullptr && (symbol == nullptr || !symbol->type.tube))
      return check_built_in(expr, *built_in);
    if (symbol == nullptr) {
      std::vector<std::string> names;
      for (const Symbol& known : model_.symbols) {
        const bool callable = known.as<FunctionItem>() != nullptr || known.type.tube;
        if (callable) names.emplace_back(known.name.text);
      }
      for (const BuiltInFunction& known : built_in_functions()) names.emplace_back(known.name);
      diagnostics()
          .report(Code::unknown_function, callee.range, callee.text)
          .did_you_mean(callee.text, names);
      return {};
    }
  }
  const Type type = check(callee);
  if (type.is_error()) return {};
  if (type.tube && type.is(Type::Kind::real)) return check_instant(expr, type);
  diagnostics().report(Code::not_callable, callee.range, callee.range.text().substr(0, 40), describe(type));
  return {};
}

bool Checker::check_count(const Expr& expr, std::string_view name, std::size_t fewest, std::size_t most) {
  const std::size_t count = expr.operands.size() - 1;
  if (fewest <= count && count <= most) return true;
  const auto plural = [](std::size_t n) { return fmt::format("{} argument{}", n, n == 1 ? "" : "s"); };
  const std::string wanted = most == fewest ? plural(fewest)
                             : most == 255  ? fmt::format("at least {}", plural(fewest))
                                            : fmt::format("{} to {}", fewest, plural(most));
  diagnostics().report(Code::wrong_argument_count, expr.operands[0]->range, name, wanted, count);
  return false;
}

Type Checker::check_function_call(const Expr& expr, const Symbol& function) {
  std::vector<Type> arguments;
  bool bad = false;
  const std::uint32_t instants_before = instants_to_find_;
  for (std::size_t i = 1; i < expr.operands.size(); ++i) {
    arguments.push_back(check(*expr.operands[i]));
    bad = bad || arguments.back().is_error();
  }
  const std::size_t count = function.as<FunctionItem>()->parameters.size();
  if (!check_count(expr, function.name.text, count, count) || bad || function.type.is_error()) return {};
  if (function.takes_instants) ++instants_to_find_;
  const bool at_instants = function.type.is(Type::Kind::boolean) && instants_to_find_ != instants_before;
  if (at_instants || function.states) model_.set_stated(expr);
  const bool varies =
      std::any_of(arguments.begin(), arguments.end(), [](const Type& type) { return type.tube; });
  if (model_.has_phases() && varies && function.type.is(Type::Kind::boolean) &&
      !holds_pointwise(*function.as<FunctionItem>()->body))
    return not_supported(expr.range, "a choice at every instant on a time line with phases");
  Type type = function.type;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const Type& wanted = function.parameters[i];
    if (arguments[i].kind != wanted.kind || !arguments[i].has_shape_of(wanted)) {
      diagnostics()
          .report(Code::wrong_type, expr.operands[i + 1]->range, describe(wanted), describe(arguments[i]))
          .note(fmt::format("it is `{}` of `{}`", function.as<FunctionItem>()->parameters[i].name.text,
                            function.name.text));
      return {};
    }
    if (model_.is_stated(*expr.operands[i + 1]) && arguments[i].tube)
      return not_supported(expr.operands[i + 1]->range, "this relation as an argument of a function");
    type.tube = type.tube || arguments[i].tube;
    // What depends on parameters alone is known once the arguments are.
    if (function.type.known == Known::at_call) {
      type.known = i == 0 ? arguments[i].known : std::min(type.known, arguments[i].known);
    }
  }
  return type;
}

Type Checker::check_instant(const Expr& expr, const Type& callee) {
  const std::string name(expr.operands[0]->range.text().substr(0, 40));
  if (!check_count(expr, name, 1, 1)) return {};
  const Expr& instant = *expr.operands[1];
  const Type type = check(instant);
  if (type.is_error()) return {};
  Type at = callee;
  at.known = Known::by_solving;
  if (instant.kind == ExprKind::name && model_.reference(instant).symbol == model_.time) return at;
  if (!type.is_scalar_real()) {
    diagnostics().report(Code::wrong_type, instant.range, "an instant", describe(type));
    return {};
  }
  if (type.tube) {
    if (delay_of(instant) != nullptr && !model_.has_phases()) return at;
    return not_supported(instant.range, "a tube at a time that is not `t - d` with a constant d");
  }
  take_instant(instant, type);
  at.tube = false;
  return at;
}

// The d of t - d and t + d, a constant; null for anything else.
const Expr* Checker::delay_of(const Expr& instant) const {
  const bool is_sum =
      instant.kind == ExprKind::binary && (instant.op == Operator::subtract || instant.op == Operator::add);
  if (!is_sum) return nullptr;
  const Expr &time = *instant.operands[0], &delay = *instant.operands[1];
  const bool from_now = time.kind == ExprKind::name && model_.reference(time).symbol == model_.time;
  return from_now && model_.type(delay).known != Known::by_solving ? &delay : nullptr;
}

void Checker::take_instant(const Expr& instant, const Type& type) {
  if (model_.has_phases()) return;  // the compiler sees whether it is a gate
  if (type.known == Known::now) model_.instants.push_back(&instant);
  // Of a parameter of a function it shows at the call only whether the instant is known.
  if (type.known == Known::by_solving || type.known == Known::at_call) ++instants_to_find_;
}

// integral(x, a, b), of a number or a vector that varies with time or does not.
Type Checker::check_integral(const Expr& expr) {
  if (model_.has_phases()) {
    diagnostics()
        .report(Code::not_supported, expr.range, "`integral` on a time line with phases")
        .note("declare a tube y with der(y) == x and y(0) == 0");
    return {};
  }
  const Type type = check(*expr.operands[1]);
  bool bad = type.is_error();
  if (!bad && (!type.is(Type::Kind::real) || type.is_array() || type.is_matrix())) {
    diagnostics().report(Code::wrong_type, expr.operands[1]->range, "a tube", describe(type));
    bad = true;
  }
  for (std::size_t i = 2; i < expr.operands.size(); ++i) {
    const Type end = check(*expr.operands[i]);
    if (!end.is_error() && require_scalar(*expr.operands[i], end)) {
      take_instant(*expr.operands[i], end);
    } else {
      bad = true;
    }
  }
  if (!bad && model_.time == nullptr) {
    diagnostics().report(Code::no_time_line, expr.range);
    bad = true;
  }
  if (bad) return {};
  ++instants_to_find_;  // where the integrand is undefined, what uses the integral is false
  return {Type::Kind::real, false, type.dim, Known::by_solving, nullptr};
}

Type Checker::check_built_in(const Expr& expr, const BuiltInFunction& function) {
  Expr& callee = *expr.operands[0];
  model_.set_reference(callee, {nullptr, Reference::kNoLocal, function.id});
  if (!check_count(expr, function.name, function.fewest_arguments, function.most_arguments)) return {};
  switch (function.id) {
    case BuiltIn::unsupported:
      return not_supported(callee.range, fmt::format("`{}`", function.name));
    case BuiltIn::der:
      return check_der(expr);
    case BuiltIn::distance:
      return check_distance(expr);
    case BuiltIn::integral:
      return check_integral(expr);
    case BuiltIn::at_least:
      return check_at_least(expr);
    case BuiltIn::disjoint:
    case BuiltIn::meets:
    case BuiltIn::subset:
      check_pair(*expr.operands[1], *expr.operands[2]);
      return check_set_relation(expr, *expr.operands[1], *expr.operands[2]);
    case BuiltIn::complement:
      return check_complement(expr, 0);
    default:
      break;
  }
  std::vector<Type> arguments;
  for (std::size_t i = 1; i < expr.operands.size(); ++i) arguments.push_back(check(*expr.operands[i]));
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (arguments[i].is_error()) return {};
    if (arguments[i].is(Type::Kind::domain)) return domain_in_expression(*expr.operands[i + 1]);
  }
  switch (function.id) {
    case BuiltIn::norm:
    case BuiltIn::dot:
    case BuiltIn::sum:
    case BuiltIn::prod:
      return check_vector_function(expr, function, arguments);
    case BuiltIn::cross:
    case BuiltIn::det:
    case BuiltIn::inverse:
    case BuiltIn::transpose:
    case BuiltIn::zeros:
    case BuiltIn::rot:
      return check_matrix_function(expr, function, arguments);
    case BuiltIn::first:
    case BuiltIn::last:
    case BuiltIn::rows:
      return check_data_function(expr, function, arguments);
    case BuiltIn::gate:
      return check_gate(expr, arguments[0]);
    case BuiltIn::hold:
      if (arguments.size() == 1) return check_hold_in_phases(expr, arguments[0]);
      return check_given_function(expr, function, arguments);
    case BuiltIn::sampled:
      return check_given_function(expr, function, arguments);
    case BuiltIn::min:
    case BuiltIn::max:
      if (arguments.size() == 1) return check_vector_function(expr, function, arguments);
      return check_scalar_function(expr, function, arguments);
    default:
      return check_scalar_function(expr, function, arguments);
  }
}

Type Checker::check_scalar_function(const Expr& expr, const BuiltInFunction& function,
                                    const std::vector<Type>& arguments) {
  Type type{Type::Kind::real, false, 0, Known::now, nullptr};
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (arguments[i].is(Type::Kind::column)) {
      return not_supported(expr.operands[i + 1]->range,
                           fmt::format("`{}` of a column of data", function.name));
    }
    if (!arguments[i].is_scalar_real()) {
      diagnostics().report(Code::wrong_type, expr.operands[i + 1]->range, "`real`", describe(arguments[i]));
      return {};
    }
    type = combined(Type::Kind::real, 0, type, arguments[i]);
  }
  if (function.id == BuiltIn::root) return check_root(expr, type);
  return type;
}

Type Checker::check_root(const Expr& expr, const Type& type) {
  const Expr& degree = *expr.operands[2];
  const Type found = model_.type(degree);
  if (!require_known(degree, found)) return {};
  const auto whole = found.known == Known::now ? constants_.whole(degree) : std::optional(1);
  if (!whole || *whole >= 1) return whole ? type : Type{};
  diagnostics().report(Code::wrong_type, degree.range, "a whole number from 1", fmt::format("{}", *whole));
  return {};
}

Type Checker::check_vector_function(const Expr& expr, const BuiltInFunction&,
                                    const std::vector<Type>& arguments) {
  Type type{Type::Kind::real, false, 0, Known::now, nullptr};
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const bool is_list = arguments[i].is(Type::Kind::real) && arguments[i].sizes().size() == 1;
    if (!is_list) {
      diagnostics().report(Code::wrong_type, expr.operands[i + 1]->range, "a vector", describe(arguments[i]));
      return {};
    }
    if (!arguments[i].has_shape_of(arguments[0])) {
      diagnostics().report(Code::sizes_differ, expr.range, describe(arguments[0]), describe(arguments[i]));
      return {};
    }
    type = combined(Type::Kind::real, 0, type, arguments[i]);
  }
  return type;
}

Type Checker::check_data_function(const Expr& expr, const BuiltInFunction& function,
                                  const std::vector<Type>& arguments) {
  const bool takes_table = function.id == BuiltIn::rows;
  const Type& type = arguments[0];
  const bool fits = takes_table ? type.is(Type::Kind::table) : type.is(Type::Kind::column) && type.dim == 0;
  if (!fits) {
    diagnostics().report(Code::wrong_type, expr.operands[1]->range,
                         takes_table ? "a table of data" : "a column of data", describe(type));
    return {};
  }
  return {Type::Kind::real, false, 0, Known::now, nullptr};
}

Type Checker::check_given_function(const Expr& expr, const BuiltInFunction& function,
                                   const std::vector<Type>& arguments) {
  if (model_.has_phases()) return not_supported(expr.range, "data on a time line with phases");
  if (!arguments[0].is(Type::Kind::column) || arguments[0].dim != 0) {
    diagnostics().report(Code::wrong_type, expr.operands[1]->range, "a column of stamps",
                         describe(arguments[0]));
    return {};
  }
  if (!arguments[1].is(Type::Kind::column)) {
    diagnostics().report(Code::wrong_type, expr.operands[2]->range, "a column of data",
                         describe(arguments[1]));
    return {};
  }
  if (arguments[0].data != arguments[1].data) {
    diagnostics().report(Code::rows_differ, expr.operands[2]->range, arguments[0].data->name.text,
                         arguments[1].data->name.text);
    return {};
  }
  if (arguments.size() == 3 && (!require_scalar(*expr.operands[3], arguments[2]) ||
                                !require_constant(*expr.operands[3], arguments[2]))) {
    return {};
  }
  if (model_.time == nullptr) {
    diagnostics()
        .report(Code::no_time_line, expr.range)
        .note(fmt::format("`{}` makes a tube", function.name));
    return {};
  }
  return {Type::Kind::domain, true, arguments[1].dim, Known::now, arguments[1].data};
}

Type Checker::check_der(const Expr& expr) {
  const Type type = check(*expr.operands[1]);
  if (type.is_error()) return {};
  if (!is_stated_side(expr)) {
    diagnostics().report(Code::der_misplaced, expr.range);
    return {};
  }
  model_.set_stated(expr);
  const Expr& argument = *expr.operands[1];
  const Expr& named = argument.kind == ExprKind::index ? *argument.operands[0] : argument;
  const Symbol* symbol = named.kind == ExprKind::name ? model_.reference(named).symbol : nullptr;
  const bool is_tube = symbol != nullptr &&
                       (symbol->as<VarItem>() != nullptr || symbol->as<GivenItem>() != nullptr) && type.tube;
  if (!is_tube || type.is_array()) {
    diagnostics().report(Code::der_of_what, argument.range);
    return {};
  }
  return type;
}

}  // namespace hcsp::lang
