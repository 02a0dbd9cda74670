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

bool Evaluator::all_whole(const Expr& expr) {
  if (model_.type(expr).is_scalar()) return whole(expr).has_value();
  const Value components = value(expr);
  const bool good = std::all_of(components.begin(), components.end(), [](const Term& term) {
    const auto* number = std::get_if<Number>(&term);
    return number != nullptr && number->exact && number->exact->as_int();
  });
  if (!good) {
    model_.diagnostics().report(Code::wrong_type, expr.range, "whole numbers",
                                fmt::format("`{}`", expr.range.text().substr(0, 40)));
  }
  return good && !components.empty();
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

std::optional<Box> Evaluator::certain_box(const Expr& expr) {
  const auto between = [](double lo, double hi) { return lo <= hi ? Interval(lo, hi) : Interval::empty(); };
  const auto enclosure = [](const Term& term) { return std::get<Number>(term).enclosure; };
  DomainValue found;
  if (model_.type(expr).is(Type::Kind::real)) {
    for (const Term& term : value(expr)) found.push_back({term, term});
  } else {
    found = domain(expr);
  }
  if (found.empty()) return {};
  Box box(static_cast<Eigen::Index>(found.size()));
  for (std::size_t i = 0; i < found.size(); ++i) {
    box[static_cast<Eigen::Index>(i)] = between(found[i].lo ? enclosure(*found[i].lo).hi() : -kInfinity,
                                                found[i].hi ? enclosure(*found[i].hi).lo() : kInfinity);
  }
  return box;
}

void Evaluator::bind(std::uint32_t local, Value value) { locals_[local] = std::move(value); }

// What is stated as a constraint is no value: a connective of it, a relation between sets, a derivative. A
// relation between reals at an instant to be found is stated, but has a value.
bool Evaluator::has_value(const Expr& expr) const {
  if (!model_.is_stated(expr) || expr.kind == ExprKind::name) return true;
  if (expr.kind == ExprKind::call) {
    const Reference callee = model_.reference(*expr.operands[0]);
    return callee.built_in == BuiltIn::none && !(callee.symbol != nullptr && callee.symbol->states);
  }
  if (expr.kind != ExprKind::binary || is_logical(expr.op)) return false;
  const Type side = model_.type(*expr.operands[1]);
  const bool of_reals = side.is(Type::Kind::real) || side.is(Type::Kind::domain);
  return of_reals && !model_.is_stated(*expr.operands[0]) && !model_.is_stated(*expr.operands[1]);
}

Value Evaluator::value(const Expr& expr) {
  if (!take_step(expr)) return {};
  if (!has_value(expr)) return truth_of_ ? truth_of_(expr) : Value{};
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
      if (model_.has_phases() && expr.bindings[0].domain == nullptr)
        return value(*expr.operands[0]);  // forall(t)
      if (expr.quantifier == Quantifier::forall || expr.quantifier == Quantifier::exists)
        return over_reals(expr);
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
  if (reference.symbol == nullptr) return {Number::of(pi(), "pi", {})};
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

}  // namespace hcsp::lang
