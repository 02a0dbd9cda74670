// SPDX-License-Identifier: Apache-2.0
#include "lang/evaluate/evaluator.h"

#include <algorithm>

#include "lang/syntax/parser.h"

namespace hcsp::lang {

namespace {

// Inlining functions in functions doubles at each level: a model must not be able to fill the memory.
constexpr std::uint64_t kMostSteps = 5'000'000;
constexpr std::uint32_t kDeepestEvaluation = 2000;

hcsp::Expr compare(Operator op, const hcsp::Expr& a, const hcsp::Expr& b) {
  switch (op) {
    case Operator::equal:
      return a == b;
    case Operator::not_equal:
      return a != b;
    case Operator::less:
      return a < b;
    case Operator::less_equal:
      return a <= b;
    case Operator::greater:
      return a > b;
    default:
      return a >= b;
  }
}

}  // namespace

// ---- Entries.

bool Evaluator::take_step(const Expr& expr) {
  if (++steps_ == kMostSteps) model_.diagnostics().report(Code::too_large, expr.range, kMostSteps);
  if (depth_ >= kDeepestEvaluation) {
    model_.diagnostics().report(Code::too_deep, expr.range, kDeepestNesting, kDeepestTree);
    steps_ = kMostSteps;  // one report is enough
  }
  return steps_ < kMostSteps;
}

std::optional<Number> Evaluator::number(const Expr& expr) {
  const Value found = value(expr);
  if (found.empty()) return {};
  const auto* constant = std::get_if<Number>(&found.front());
  return constant == nullptr ? std::nullopt : std::optional(*constant);
}

std::optional<int> Evaluator::whole(const Expr& expr) {
  const auto found = number(expr);
  if (!found) return {};
  if (found->exact) {
    if (const auto value = found->exact->as_int()) return value;
  }
  model_.diagnostics().report(Code::wrong_type, expr.range, "a whole number",
                              fmt::format("`{}`", expr.range.text().substr(0, 40)));
  return {};
}

std::optional<Box> Evaluator::box(const Expr& expr) {
  const auto enclosure = [](const Term& term) { return std::get<Number>(term).enclosure; };
  if (model_.type(expr).is(Type::Kind::real)) {
    const Value found = value(expr);
    if (found.empty()) return {};
    Box box(static_cast<Eigen::Index>(found.size()));
    for (std::size_t i = 0; i < found.size(); ++i) box[static_cast<Eigen::Index>(i)] = enclosure(found[i]);
    return box;
  }
  const DomainValue found = domain(expr);
  if (found.empty()) return {};
  Box box(static_cast<Eigen::Index>(found.size()));
  for (std::size_t i = 0; i < found.size(); ++i) {
    const double lo = found[i].lo ? enclosure(*found[i].lo).lo() : -kInfinity;
    const double hi = found[i].hi ? enclosure(*found[i].hi).hi() : kInfinity;
    box[static_cast<Eigen::Index>(i)] = Interval(lo, hi);
  }
  return box;
}

void Evaluator::bind(std::uint32_t local, Value value) { locals_[local] = std::move(value); }

hcsp::Expr Evaluator::expression(Problem& problem, const Term& term) {
  if (const auto* number = std::get_if<Number>(&term)) return problem.constant(number->enclosure);
  return std::get<hcsp::Expr>(term);
}

Value Evaluator::value(const Expr& expr) {
  if (!take_step(expr)) return {};
  ++depth_;
  Value found = value_of_kind(expr);
  --depth_;
  return found;
}

Value Evaluator::value_of_kind(const Expr& expr) {
  switch (expr.kind) {
    case ExprKind::number: {
      const auto written = Number::parse(expr.text);
      return written ? Value{*written} : Value{};
    }
    case ExprKind::boolean:
      return {Number::of(Interval(expr.text == "true" ? 1.0 : 0.0))};
    case ExprKind::name:
      return name(expr);
    case ExprKind::index:
      return index(expr);
    case ExprKind::call:
      return call(expr);
    case ExprKind::unary:
      return unary(expr);
    case ExprKind::binary:
      return binary(expr);
    case ExprKind::conditional:
      return conditional(expr);
    case ExprKind::tuple: {
      Value components;
      for (const Expr* operand : expr.operands) {
        const Value component = value(*operand);
        if (component.empty()) return {};
        components.push_back(component.front());
      }
      return components;
    }
    case ExprKind::quantified:
      return value(*expr.operands[0]);  // the body of a minimum over a set
    default:
      return {};
  }
}

// ---- Names.

Value Evaluator::name(const Expr& expr) {
  const Reference reference = model_.reference(expr);
  if (reference.local != Reference::kNoLocal) return locals_[reference.local];
  if (reference.symbol == nullptr) return {Number::of(pi())};
  return symbol(*reference.symbol);
}

Value Evaluator::symbol(const Symbol& symbol) {
  const auto* param = symbol.as<ParamItem>();
  const auto* let = symbol.as<LetItem>();
  const Expr* definition = let != nullptr                        ? let->value
                           : param != nullptr && !symbol.unknown ? param->value
                                                                 : nullptr;
  if (definition == nullptr) return unknown(symbol);
  const std::pair key(&symbol, instant_);
  if (const auto known = definitions_.find(key); known != definitions_.end()) return known->second;
  Value found = value(*definition);
  return definitions_.emplace(key, std::move(found)).first->second;
}

Value Evaluator::unknown(const Symbol& symbol) {
  Problem& problem = unknowns_->problem;
  if (&symbol == model_.time) {
    if (instant_) return {Number::of(Interval(*instant_))};
    return {problem.time()};
  }
  const auto found = unknowns_->handles.find(&symbol);
  if (found == unknowns_->handles.end()) return {};
  VectorExpr components;
  if (const auto* real = std::get_if<RealVariable>(&found->second)) components = {problem(*real)};
  if (const auto* vector = std::get_if<VectorVariable>(&found->second)) components = problem(*vector);
  if (const auto* tube = std::get_if<TubeVariable>(&found->second)) {
    components = instant_ ? problem.at(*tube, *instant_) : problem(*tube);
  }
  return {components.begin(), components.end()};
}

Value Evaluator::index(const Expr& expr) {
  const auto place = whole(*expr.operands[1]);
  if (!place) return {};
  const auto at = static_cast<std::size_t>(*place - 1);
  if (!model_.type(*expr.operands[0]).is(Type::Kind::column)) {
    const Value base = value(*expr.operands[0]);
    return base.empty() ? Value{} : Value{base.at(at)};
  }
  const auto column = columns(*expr.operands[0]);
  if (!column) return {};
  const Column& data = column->front();
  const CellValue& cell = data.cells.at(at);
  if (cell.kind == CellValue::Kind::number) return {cell.number};
  const Code code = cell.kind == CellValue::Kind::blank ? Code::blank_cell : Code::no_echo_here;
  model_.diagnostics().report(code, data.table->range(at, data.index), data.name());
  return {};
}

// ---- Operators.

Term Evaluator::negate(const Term& a) {
  if (const auto* number = std::get_if<Number>(&a)) return -*number;
  return -std::get<hcsp::Expr>(a);
}

Term Evaluator::operate(Operator op, const Term& a, const Term& b) {
  const auto* x = std::get_if<Number>(&a);
  const auto* y = std::get_if<Number>(&b);
  if (x != nullptr && y != nullptr) {
    switch (op) {
      case Operator::add:
        return *x + *y;
      case Operator::subtract:
        return *x - *y;
      case Operator::multiply:
        return *x * *y;
      default:
        return *x / *y;
    }
  }
  const hcsp::Expr u = expression(a);
  const hcsp::Expr v = expression(b);
  switch (op) {
    case Operator::add:
      return u + v;
    case Operator::subtract:
      return u - v;
    case Operator::multiply:
      return u * v;
    default:
      return u / v;
  }
}

Value Evaluator::defined(const Expr& expr, Value value) {
  for (const Term& term : value) {
    const auto* number = std::get_if<Number>(&term);
    if (number == nullptr || !number->enclosure.is_empty()) continue;
    model_.diagnostics().report(Code::undefined_constant, expr.range);
    return {};
  }
  return value;
}

Value Evaluator::unary(const Expr& expr) {
  Value operand = value(*expr.operands[0]);
  if (operand.empty()) return {};
  if (expr.op == Operator::logical_not) return {!expression(operand.front())};
  for (Term& term : operand) term = negate(term);
  return operand;
}

Value Evaluator::binary(const Expr& expr) {
  if (expr.op == Operator::power) return power(expr);
  if (expr.op == Operator::in) return membership(expr);
  const Value a = value(*expr.operands[0]);
  const Value b = value(*expr.operands[1]);
  if (a.empty() || b.empty()) return {};
  if (is_comparison(expr.op)) return relation(expr, a, b);
  if (!is_logical(expr.op)) return arithmetic(expr, a, b);
  const hcsp::Expr p = expression(a.front());
  const hcsp::Expr q = expression(b.front());
  switch (expr.op) {
    case Operator::logical_and:
      return {p && q};
    case Operator::logical_or:
      return {p || q};
    case Operator::implies:
      return {!p || q};
    case Operator::iff:
      return {(p && q) || (!p && !q)};
    default:
      return {(p && !q) || (!p && q)};
  }
}

Value Evaluator::arithmetic(const Expr& expr, const Value& a, const Value& b) {
  Value result;
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
    result.push_back(operate(expr.op, a[a.size() == 1 ? 0 : i], b[b.size() == 1 ? 0 : i]));
  }
  return defined(expr, std::move(result));
}

Value Evaluator::power(const Expr& expr) {
  const auto exponent = whole(*expr.operands[1]);
  Value base = value(*expr.operands[0]);
  if (!exponent || base.empty()) return {};
  // Squares are tight where products are not: x^6 is ((x*x^2)^2).
  Term result = Number::of(Interval(1.0));
  const int magnitude = std::abs(*exponent);
  for (int bit = 64; bit > 0; bit /= 2) {
    if (magnitude >= 2 * bit) result = scalar_function(BuiltIn::sqr, result);
    const bool first = magnitude / (2 * bit) == 0;
    if ((magnitude & bit) != 0)
      result = first ? base.front() : operate(Operator::multiply, result, base.front());
  }
  if (*exponent < 0) result = operate(Operator::divide, *Number::parse("1"), result);
  return defined(expr, {result});
}

Value Evaluator::relation(const Expr& expr, const Value& a, const Value& b) {
  std::optional<hcsp::Expr> all;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const hcsp::Expr one = compare(expr.op, expression(a[i]), expression(b[i]));
    all = !all ? one : expr.op == Operator::not_equal ? *all || one : *all && one;
  }
  return {*all};
}

Value Evaluator::membership(const Expr& expr) {
  const Value point = value(*expr.operands[0]);
  const DomainValue bounds = domain(*expr.operands[1]);
  if (point.empty() || bounds.empty()) return {};
  std::optional<hcsp::Expr> all;
  const auto add = [&](const Term& below, const Term& above) {
    const hcsp::Expr one = expression(below) <= expression(above);
    all = all ? *all && one : one;
  };
  for (std::size_t i = 0; i < point.size(); ++i) {
    if (bounds[i].lo) add(*bounds[i].lo, point[i]);
    if (bounds[i].hi) add(point[i], *bounds[i].hi);
  }
  if (!all) return {Number::of(Interval(1.0))};
  return {*all};
}

Value Evaluator::conditional(const Expr& expr) {
  const Value condition = value(*expr.operands[0]);
  const Value then = value(*expr.operands[1]);
  const Value otherwise = value(*expr.operands[2]);
  if (condition.empty() || then.empty() || otherwise.empty()) return {};
  Value result;
  for (std::size_t i = 0; i < then.size(); ++i) {
    result.push_back(
        if_then_else(expression(condition.front()), expression(then[i]), expression(otherwise[i])));
  }
  return result;
}

}  // namespace hcsp::lang
