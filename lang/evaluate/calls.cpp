// SPDX-License-Identifier: Apache-2.0
// Calls: functions of the model, by substitution; tubes at an instant; built-in functions.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "domains/interval/functions.h"
#include "lang/evaluate/evaluator.h"

namespace hcsp::lang {

Value Evaluator::call(const Expr& expr) {
  const Reference callee = model_.reference(*expr.operands[0]);
  if (callee.built_in != BuiltIn::none) return built_in(expr, callee.built_in);
  if (callee.symbol != nullptr && callee.symbol->as<FunctionItem>() != nullptr) {
    return function_call(expr, *callee.symbol);
  }
  return at_instant(expr);
}

Value Evaluator::function_call(const Expr& expr, const Symbol& function) {
  if (!bind_arguments(expr, function)) return {};
  return value(*function.as<FunctionItem>()->body);
}

bool Evaluator::bind_arguments(const Expr& call, const Symbol& function) {
  std::vector<Value> arguments;
  for (std::size_t i = 1; i < call.operands.size(); ++i) {
    arguments.push_back(value(*call.operands[i]));
    if (arguments.back().empty()) return false;
  }
  // No function calls itself, so its locals are free.
  std::uint32_t local = function.first_local;
  for (Value& argument : arguments) bind(local++, std::move(argument));
  for (const Local& where : function.as<FunctionItem>()->locals) {
    Value found = value(*where.value);
    if (found.empty()) return false;
    bind(local++, std::move(found));
  }
  return true;
}

Value Evaluator::at_instant(const Expr& expr) {
  const Expr& instant = *expr.operands[1];
  if (instant.kind == ExprKind::name && model_.reference(instant).symbol == model_.time)
    return value(*expr.operands[0]);
  const Instant taken = varies(instant) ? delayed(instant) : instant_of(instant);
  if (std::holds_alternative<std::monostate>(taken)) return {};
  Value found;
  at(taken, [&] { found = value(*expr.operands[0]); });
  return found;
}

// The instant that an expression says; none after a report.
Instant Evaluator::instant_of(const Expr& expr) {
  const Value written = value(expr);
  if (written.empty()) return {};
  if (model_.has_phases()) return instant_of_phases(expr, expression(written.front()));
  if (const auto* found = std::get_if<hcsp::Expr>(&written.front())) {
    if (!require_all_time(expr, "an instant to be found")) return {};
    instants_to_find_.push_back(*found);
    return *found;
  }
  return known_instant(expr, std::get<Number>(written.front()));
}

Instant Evaluator::instant_of_phases(const Expr& expr, const hcsp::Expr& instant) {
  if (unknowns_->problem.gate_at(instant)) return instant;
  model_.diagnostics().report(Code::no_gate, expr.range, "an instant is 0, T or `gate(k)`");
  return {};
}

// gate(k), the instant after k phases.
Value Evaluator::gate(const Expr& expr) {
  const auto count = whole(*expr.operands[1]);
  if (!count) return {};
  const auto phases = static_cast<int>(unknowns_->problem.phases());
  if (*count >= 0 && *count <= phases) return {unknowns_->problem.gate(static_cast<std::size_t>(*count))};
  model_.diagnostics().report(Code::index_outside, expr.operands[1]->range, *count, 0, phases);
  return {};
}

// hold(f): f[i] during phase i. At a gate it is what comes after.
Value Evaluator::hold(const Expr& expr) {
  const Value values = value(*expr.operands[1]);
  if (values.empty()) return {};
  Problem& problem = unknowns_->problem;
  const std::size_t dim = values.size() / problem.phases();
  std::vector<VectorExpr> by_phase(problem.phases());
  for (std::size_t i = 0; i < values.size(); ++i) by_phase[i / dim].push_back(expression(values[i]));
  const TubeVariable held = problem.hold(by_phase);
  Value components;
  for (std::size_t c = 0; c < dim; ++c) components.emplace_back(*unknowns_->component(held, c, instant_));
  return components;
}

// x(t - d) and x(t + d), at the time at hand or at an earlier one.
Instant Evaluator::delayed(const Expr& instant) {
  const auto written = number(*instant.operands[1]);
  if (!written) return {};
  const auto* outer = std::get_if<Delay>(&instant_);
  const double further = instant.op == Operator::add ? -written->nearest() : written->nearest();
  return Delay{(outer == nullptr ? 0.0 : outer->duration) + further};
}

// What speaks of more than one instant has no place where the relations at each instant stand by themselves.
bool Evaluator::require_all_time(const Expr& expr, std::string_view what) {
  if (!unknowns_->problem.is_at_each_instant()) return true;
  model_.diagnostics().report(Code::not_supported, expr.range,
                              fmt::format("{} within a choice at every instant", what));
  return false;
}

// From the start where that is known, to the end; else backward from the end, or from the time line's start.
Value Evaluator::integral(const Expr& expr) {
  takes_integrals_ = true;
  if (!require_all_time(expr, "an integral")) return {};
  const Instant from = instant_of(*expr.operands[2]), to = instant_of(*expr.operands[3]);
  Value integrand;
  at({}, [&] { integrand = value(*expr.operands[1]); });
  if (from.index() == 0 || to.index() == 0 || integrand.empty()) return {};
  VectorExpr f;
  for (const Term& term : integrand) f.push_back(expression(term));
  const auto* known_from = std::get_if<double>(&from);
  const auto* known_to = std::get_if<double>(&to);
  Problem& problem = unknowns_->problem;
  const double origin = known_from != nullptr ? *known_from
                        : known_to != nullptr ? *known_to
                                              : problem.time_line()->start();
  const TubeVariable primitive = problem.integral(f, origin);
  const auto at_end = [&](const Instant& end) {
    if (const auto* known = std::get_if<double>(&end)) return problem.at(primitive, *known);
    return problem.at(primitive, std::get<hcsp::Expr>(end));
  };
  const VectorExpr upper = at_end(to);
  if (known_from != nullptr) return {upper.begin(), upper.end()};
  const VectorExpr difference = upper - at_end(from);
  return {difference.begin(), difference.end()};
}

// One that is none of the time line's is remembered: with it the model is compiled once more.
Instant Evaluator::known_instant(const Expr& expr, const Number& written) {
  const double at = written.nearest();
  const TimeLine& line = *unknowns_->problem.time_line();
  if (line.gate_at(at)) return at;
  if (at < line.start() || at > line.end() || std::isnan(at)) {
    model_.diagnostics().report(Code::off_the_time_line, expr.range, at, line.start(), line.end());
    return {};
  }
  missing_instants_.push_back(at);
  return line.start();
}

Value Evaluator::built_in(const Expr& expr, BuiltIn function) {
  if (function == BuiltIn::first || function == BuiltIn::last || function == BuiltIn::rows) {
    return data_value(expr, function);
  }
  if (function == BuiltIn::at_least) {
    const auto count = whole(*expr.operands[1]);
    Value relations;
    for (const Expr* relation : expr.operands[2]->operands) {
      const Value one = value(*relation);
      if (one.empty()) return {};
      relations.push_back(one.front());
    }
    return count ? at_least(*count, relations) : Value{};
  }
  if (function == BuiltIn::integral) return integral(expr);
  if (function == BuiltIn::gate) return gate(expr);
  if (function == BuiltIn::hold) return hold(expr);
  std::vector<Value> arguments;
  for (std::size_t i = 1; i < expr.operands.size(); ++i) {
    arguments.push_back(value(*expr.operands[i]));
    if (arguments.back().empty()) return {};
  }
  const Value& a = arguments.front();
  switch (function) {
    case BuiltIn::norm: {
      Value squares;
      for (const Term& term : a) squares.push_back(scalar_function(BuiltIn::sqr, term));
      return defined(expr, {scalar_function(BuiltIn::sqrt, sum_of(squares))});
    }
    case BuiltIn::dot:
      return {dot(a, arguments[1])};
    case BuiltIn::sum:
      return {sum_of(a)};
    case BuiltIn::prod:
      return {product_of(a)};
    case BuiltIn::min:
    case BuiltIn::max: {
      // Of one vector, its components; of several numbers, those.
      Value terms = a;
      for (std::size_t i = 1; i < arguments.size(); ++i) terms.push_back(arguments[i].front());
      return {extremum(function, terms)};
    }
    case BuiltIn::cross:
    case BuiltIn::det:
    case BuiltIn::inverse:
    case BuiltIn::transpose:
    case BuiltIn::zeros:
    case BuiltIn::rot:
      return matrix_function(expr, function, arguments);
    case BuiltIn::root: {
      const auto degree = whole(*expr.operands[2]);
      return degree ? defined(expr, {root_of(a.front(), *degree)}) : Value{};
    }
    case BuiltIn::atan2:
      return defined(expr, {scalar_function(function, a.front(), arguments[1].front())});
    default:
      return defined(expr, {scalar_function(function, a.front())});
  }
}

Value Evaluator::data_value(const Expr& expr, BuiltIn function) {
  const Expr& argument = *expr.operands[1];
  if (function == BuiltIn::rows) {
    const Table& table = *model_.type(argument).data->table;
    return {*Number::parse(std::to_string(table.rows()))};
  }
  const auto column = columns(argument);
  if (!column) return {};
  return cell(column->front(), function == BuiltIn::first ? 0 : column->front().cells.size() - 1);
}

Value Evaluator::cell(const Column& column, std::size_t row) {
  const CellValue& cell = column.cells[row];
  if (cell.kind == CellValue::Kind::number) return {cell.number};
  const Code code = cell.kind == CellValue::Kind::blank ? Code::blank_cell : Code::no_echo_here;
  model_.diagnostics().report(code, column.table->range(row, column.index), column.name());
  return {};
}

}  // namespace hcsp::lang
