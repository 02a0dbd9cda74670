// SPDX-License-Identifier: Apache-2.0
#include "lang/evaluate/evaluator.h"

#include <algorithm>

#include "domains/interval/functions.h"
#include "lang/syntax/parser.h"

namespace hcsp::lang {

namespace {

// Inlining functions in functions doubles at each level: a model must not be able to fill the memory.
constexpr std::uint64_t kMostSteps = 5'000'000;
constexpr std::uint32_t kDeepestEvaluation = 2000;
constexpr int kMostExactFactors = 64;

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

/// a < b, a > b or a != b of whole numbers: they differ by 1 at least.
hcsp::Expr apart(Operator op, const hcsp::Expr& a, const hcsp::Expr& b) {
  const Interval one(1.0);
  if (op == Operator::not_equal) return a + one <= b || b + one <= a;
  return op == Operator::less ? a + one <= b : b + one <= a;
}

/// Whether a term of this type is whole whatever the unknowns are.
bool is_whole(const Type& type, const Term& term) {
  const auto* number = std::get_if<Number>(&term);
  return type.whole || (number != nullptr && number->exact && number->exact->as_int());
}

/// How a comparison of constants ends, where their enclosures tell.
std::optional<bool> known_relation(Operator op, const Term& a, const Term& b) {
  const auto* x = std::get_if<Number>(&a);
  const auto* y = std::get_if<Number>(&b);
  if (x == nullptr || y == nullptr) return {};
  const Interval difference = (*x - *y).enclosure;
  const bool is_zero = difference.lo() == 0 && difference.hi() == 0;
  const bool below = difference.hi()<0, above = difference.lo()> 0;
  if (!is_zero && !below && !above) return {};
  switch (op) {
    case Operator::equal:
      return is_zero;
    case Operator::not_equal:
      return !is_zero;
    case Operator::less:
      return below;
    case Operator::less_equal:
      return !above;
    case Operator::greater:
      return above;
    default:
      return !below;
  }
}

/// A connective whose first operand decides it: the second need not exist then.
std::optional<Term> decided_by_first(Operator op, const Term& a) {
  const auto known = is_logical(op) ? Evaluator::truth(a) : std::nullopt;
  if (!known) return {};
  if (op == Operator::logical_and && !*known) return boolean(false);
  if (op == Operator::logical_or && *known) return boolean(true);
  if (op == Operator::implies && !*known) return boolean(true);
  return {};
}

/// A connective of which an operand is a constant.
std::optional<Term> known_logic(Operator op, const Term& a, const Term& b) {
  const auto p = Evaluator::truth(a), q = Evaluator::truth(b);
  if (!p && !q) return {};
  const auto negation = [](const Term& term) -> Term {
    if (const auto known = Evaluator::truth(term)) return boolean(!*known);
    return !std::get<hcsp::Expr>(term);
  };
  const bool known = p ? *p : *q;
  const Term& other = p ? b : a;
  switch (op) {
    case Operator::logical_and:
      return known ? other : boolean(false);
    case Operator::logical_or:
      return known ? boolean(true) : other;
    case Operator::implies:
      if (p) return known ? other : boolean(true);
      return known ? boolean(true) : negation(other);
    case Operator::iff:
      return known ? other : negation(other);
    default:
      return known ? negation(other) : other;
  }
}

}  // namespace

Term boolean(bool truth) { return Number::of(Interval(truth ? 1.0 : 0.0)); }

std::optional<bool> Evaluator::truth(const Term& term) {
  const auto* number = std::get_if<Number>(&term);
  if (number == nullptr || !number->enclosure.is_point()) return {};
  return number->enclosure.lo() != 0;
}

Evaluator::Evaluator(Model& model)
    : model_(model),
      scratch_(std::make_unique<Problem>("constants")),
      none_(Unknowns{*scratch_, {}}),
      unknowns_(&*none_) {}

// ---- Entries.

bool Evaluator::take_step(const Expr& expr) {
  if (++steps_ == kMostSteps) model_.diagnostics().report(Code::too_large, expr.range, kMostSteps);
  if (depth_ >= kDeepestEvaluation) {
    model_.diagnostics().report(Code::too_deep, expr.range, kDeepestNesting, kDeepestTree);
    steps_ = kMostSteps;  // one report is enough
  }
  return steps_ < kMostSteps;
}

bool Evaluator::take_steps(const Expr& expr, std::int64_t count) {
  if (count < 0 || steps_ + static_cast<std::uint64_t>(count) < kMostSteps) return true;
  if (steps_ < kMostSteps) model_.diagnostics().report(Code::too_large, expr.range, kMostSteps);
  steps_ = kMostSteps;
  return false;
}

std::optional<Number> Evaluator::number(const Expr& expr) {
  const Value found = value(expr);
  if (found.empty()) return {};
  if (const auto* constant = std::get_if<Number>(&found.front())) return *constant;
  model_.diagnostics().report(Code::not_constant, expr.range);
  return {};
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

// What is stated as a constraint is no value: a connective of it, a relation between sets, a derivative. A
// relation between reals at an instant to be found is stated, but has a value.
bool Evaluator::has_value(const Expr& expr) {
  if (!model_.is_stated(expr) || expr.kind == ExprKind::name) return true;
  if (expr.kind == ExprKind::binary && !is_logical(expr.op)) {
    const Type side = model_.type(*expr.operands[1]);
    if (side.is(Type::Kind::real) || side.is(Type::Kind::domain)) return true;
  }
  const bool is_function =
      expr.kind == ExprKind::call && model_.reference(*expr.operands[0]).built_in == BuiltIn::none;
  if (is_function) return true;
  model_.diagnostics().report(Code::not_supported, expr.range, "this relation within another");
  return false;
}

Value Evaluator::value(const Expr& expr) {
  if (!take_step(expr) || !has_value(expr)) return {};
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
      return {boolean(expr.text == "true")};
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
        components.insert(components.end(), component.begin(), component.end());
      }
      return components;
    }
    case ExprKind::comprehension:
      return comprehension(expr);
    case ExprKind::quantified:
      if (ranges_over_numbers(expr)) return over_range(expr);
      return value(*expr.operands[0]);  // the body of a minimum over a set
    default:
      return {};
  }
}

// ---- Names.

std::optional<hcsp::Expr> Unknowns::component(const Handle& handle, std::size_t i,
                                              const Instant& instant) const {
  if (const auto* real = std::get_if<RealVariable>(&handle)) return problem(*real);
  if (const auto* integer = std::get_if<IntegerVariable>(&handle)) return problem(*integer);
  if (const auto* boolean = std::get_if<BooleanVariable>(&handle)) return problem(*boolean);
  if (const auto* vector = std::get_if<VectorVariable>(&handle)) return problem.component(*vector, i);
  const auto* tube = std::get_if<TubeVariable>(&handle);
  if (tube == nullptr) return {};
  if (const auto* known = std::get_if<double>(&instant)) return problem.at(*tube, *known)[i];
  if (const auto* found = std::get_if<hcsp::Expr>(&instant)) return problem.at(*tube, *found)[i];
  if (const auto* delay = std::get_if<Delay>(&instant)) return problem.delayed(*tube, delay->duration)[i];
  return problem(*tube)[i];
}

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
  // A tube at an instant to be found is one value an alternative.
  if (symbol.takes_instants || std::holds_alternative<hcsp::Expr>(instant_)) return value(*definition);
  const DefinitionKey key = key_of(symbol);
  if (const auto known = definitions_.find(key); known != definitions_.end()) return known->second;
  Value found = value(*definition);
  return definitions_.emplace(key, std::move(found)).first->second;
}

Evaluator::DefinitionKey Evaluator::key_of(const Symbol& symbol) const {
  const auto* known = std::get_if<double>(&instant_);
  const auto* delay = std::get_if<Delay>(&instant_);
  return {&symbol, instant_.index(), known != nullptr ? *known : delay != nullptr ? delay->duration : 0.0};
}

// The element of an array, or the unknown itself, that an expression names, and the first of its components;
// none where it names none, or after a report.
std::optional<std::pair<Unknowns::Handle, std::size_t>> Evaluator::handle(const Expr& expr) {
  const bool indexed = expr.kind == ExprKind::index;
  const Expr& named = indexed ? *expr.operands[0] : expr;
  const Symbol* symbol = named.kind == ExprKind::name ? model_.reference(named).symbol : nullptr;
  const auto found = unknowns_->handles.find(symbol);
  if (symbol == nullptr || found == unknowns_->handles.end()) return {};
  std::size_t first = 0;
  Type type = symbol->type;
  for (std::size_t i = 1; indexed && i < expr.operands.size(); ++i) {
    const auto at = offset(*expr.operands[i], type);
    if (!at) return {};
    type = component_of(type);
    first += *at * type.terms();
  }
  const std::size_t each = symbol->type.components();
  return std::pair(found->second[first / each], first % each);
}

std::optional<SetVariable> Evaluator::set(const Expr& expr) {
  if (!model_.type(expr).is(Type::Kind::set)) return {};
  const auto found = handle(expr);
  return found ? std::optional(std::get<SetVariable>(found->first)) : std::nullopt;
}

std::optional<Evaluator::TubeComponents> Evaluator::tube(const Expr& expr) {
  const auto found = handle(expr);
  if (!found || !std::holds_alternative<TubeVariable>(found->first)) return {};
  return TubeComponents{std::get<TubeVariable>(found->first), found->second, model_.type(expr).terms()};
}

Value Evaluator::unknown(const Symbol& symbol) {
  if (&symbol == model_.time) {
    if (const auto* known = std::get_if<double>(&instant_)) return {Number::of(Interval(*known))};
    if (const auto* found = std::get_if<hcsp::Expr>(&instant_)) return {*found};
    const hcsp::Expr time = unknowns_->problem.time();
    if (const auto* delay = std::get_if<Delay>(&instant_)) return {time - Interval(delay->duration)};
    return {time};
  }
  return unknown_part(symbol, 0, symbol.type.terms());
}

// Of an unknown; of any other symbol nothing.
Value Evaluator::unknown_part(const Symbol& symbol, std::size_t first, std::size_t count) {
  const auto found = unknowns_->handles.find(&symbol);
  if (found == unknowns_->handles.end()) return {};
  const std::size_t each = symbol.type.components();
  Value components;
  for (std::size_t i = first; i < first + count; ++i) {
    const auto component = unknowns_->component(found->second[i / each], i % each, instant_);
    if (!component) return {};
    components.emplace_back(*component);
  }
  return components;
}

// Where the component that an index names starts, in components of that size.
std::optional<std::size_t> Evaluator::offset(const Expr& written, const Type& base) {
  const auto place = whole(written);
  if (!place) return {};
  if (!require_index(base, *place, written.range, model_.diagnostics())) return {};
  return static_cast<std::size_t>(*place - index_range(base).first);
}

Value Evaluator::index(const Expr& expr) {
  const Type base = model_.type(*expr.operands[0]);
  if (base.is(Type::Kind::column)) {
    const auto row = offset(*expr.operands[1], base);
    const auto column = row ? columns(*expr.operands[0]) : std::nullopt;
    return column ? cell(column->front(), *row) : Value{};
  }
  return part(expr, 0, model_.type(expr).terms());
}

Value Evaluator::part(const Expr& expr, std::size_t first, std::size_t count) {
  if (expr.kind == ExprKind::index && !model_.type(*expr.operands[0]).is(Type::Kind::column)) {
    Type type = model_.type(*expr.operands[0]);
    for (std::size_t i = 1; i < expr.operands.size(); ++i) {
      const auto at = offset(*expr.operands[i], type);
      if (!at) return {};
      type = component_of(type);
      first += *at * type.terms();
    }
    return part(*expr.operands[0], first, count);
  }
  if (expr.kind == ExprKind::name) {
    const Reference reference = model_.reference(expr);
    if (reference.symbol != nullptr) {
      if (auto found = unknown_part(*reference.symbol, first, count); !found.empty()) return found;
    }
  }
  const Value whole_value = value(expr);
  if (whole_value.empty()) return {};
  const auto begin = whole_value.begin() + static_cast<std::ptrdiff_t>(first);
  return {begin, begin + static_cast<std::ptrdiff_t>(count)};
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
  if (expr.op == Operator::logical_not) {
    if (const auto known = truth(operand.front())) return {boolean(!*known)};
    return {!expression(operand.front())};
  }
  for (Term& term : operand) term = negate(term);
  return operand;
}

Value Evaluator::binary(const Expr& expr) {
  if (expr.op == Operator::power) return power(expr);
  if (expr.op == Operator::in) return membership(expr);
  const Value a = value(*expr.operands[0]);
  if (a.empty()) return {};
  if (const auto decided = decided_by_first(expr.op, a.front())) return {*decided};
  const Value b = value(*expr.operands[1]);
  if (b.empty()) return {};
  if (is_comparison(expr.op)) return relation(expr, a, b);
  if (is_logical(expr.op)) return {connect(expr.op, a.front(), b.front())};
  return arithmetic(expr, a, b);
}

Term Evaluator::connect(Operator op, const Term& a, const Term& b) {
  if (const auto known = known_logic(op, a, b)) return *known;
  const hcsp::Expr p = expression(a);
  const hcsp::Expr q = expression(b);
  switch (op) {
    case Operator::logical_and:
      return p && q;
    case Operator::logical_or:
      return p || q;
    case Operator::implies:
      return !p || q;
    case Operator::iff:
      return (p && q) || (!p && !q);
    default:
      return (p && !q) || (!p && q);
  }
}

Value Evaluator::arithmetic(const Expr& expr, const Value& a, const Value& b) {
  const Type &of_a = model_.type(*expr.operands[0]), &of_b = model_.type(*expr.operands[1]);
  if (expr.op == Operator::multiply && !of_a.is_scalar() && !of_b.is_scalar() && of_a.is(Type::Kind::real))
    return product(expr, a, b);
  Value result;
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i) {
    result.push_back(operate(expr.op, a[a.size() == 1 ? 0 : i], b[b.size() == 1 ? 0 : i]));
  }
  return defined(expr, std::move(result));
}

Value Evaluator::power(const Expr& expr) {
  const Value base = value(*expr.operands[0]);
  const Value exponent = base.empty() ? Value{} : value(*expr.operands[1]);
  if (exponent.empty()) return {};
  const auto* number = std::get_if<Number>(&exponent.front());
  const auto whole = number != nullptr && number->exact ? number->exact->as_int() : std::nullopt;
  if (whole) return defined(expr, {power_of(base.front(), *whole)});
  const auto* known = std::get_if<Number>(&base.front());
  if (known != nullptr && number != nullptr)
    return defined(expr, {Number::of(pow(known->enclosure, number->enclosure))});
  return {pow(expression(base.front()), expression(exponent.front()))};
}

Term Evaluator::power_of(const Term& base, int exponent) {
  if (exponent == 1) return base;
  if (exponent == 2) return scalar_function(BuiltIn::sqr, base);
  const auto* number = std::get_if<Number>(&base);
  if (number == nullptr) return pown(std::get<hcsp::Expr>(base), exponent);
  const Number rounded = Number::of(pown(number->enclosure, exponent));
  if (!number->exact || exponent < 0 || exponent > kMostExactFactors) return rounded;
  Number product = *Number::parse("1");
  for (int i = 0; i < exponent; ++i) product = product * *number;
  return product.exact ? product : rounded;
}

Value Evaluator::relation(const Expr& expr, const Value& a, const Value& b) {
  const bool any = expr.op == Operator::not_equal;
  if (model_.type(*expr.operands[0]).is(Type::Kind::boolean))
    return {connect(any ? Operator::logical_xor : Operator::iff, a.front(), b.front())};
  std::optional<hcsp::Expr> all;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (const auto known = known_relation(expr.op, a[i], b[i])) {
      if (*known == any) return {boolean(any)};
      continue;
    }
    const bool strict =
        expr.op == Operator::less || expr.op == Operator::greater || expr.op == Operator::not_equal;
    const bool whole_sides =
        is_whole(model_.type(*expr.operands[0]), a[i]) && is_whole(model_.type(*expr.operands[1]), b[i]);
    const hcsp::Expr one = strict && whole_sides ? apart(expr.op, expression(a[i]), expression(b[i]))
                                                 : compare(expr.op, expression(a[i]), expression(b[i]));
    all = !all ? one : any ? *all || one : *all && one;
  }
  return {all ? Term(*all) : boolean(!any)};
}

Value Evaluator::membership(const Expr& expr) {
  const Value point = value(*expr.operands[0]);
  if (model_.type(*expr.operands[1]).is(Type::Kind::set))
    return membership_in_builder(*expr.operands[1], point);
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
  if (!all) return {boolean(true)};
  return {*all};
}

// The point is in { a | relation } when the relation holds of it.
Value Evaluator::membership_in_builder(const Expr& written, const Value& point) {
  if (point.empty()) return {};
  const Expr& builder = model_.unfold(written);
  const std::uint32_t local = model_.reference(builder).local;
  Value outer = std::exchange(locals_[local], point);
  Value relation = value(*builder.operands[0]);
  locals_[local] = std::move(outer);
  return relation;
}

Value Evaluator::conditional(const Expr& expr) {
  const Value condition = value(*expr.operands[0]);
  if (condition.empty()) return {};
  // What is not taken need not exist: x[i - 1] under `if i > 1`.
  if (const auto known = truth(condition.front())) return value(*expr.operands[*known ? 1 : 2]);
  const Value then = value(*expr.operands[1]);
  const Value otherwise = value(*expr.operands[2]);
  if (then.empty() || otherwise.empty()) return {};
  Value result;
  for (std::size_t i = 0; i < then.size(); ++i) {
    result.push_back(
        if_then_else(expression(condition.front()), expression(then[i]), expression(otherwise[i])));
  }
  return result;
}

}  // namespace hcsp::lang
