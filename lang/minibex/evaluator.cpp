// SPDX-License-Identifier: Apache-2.0
#include "lang/minibex/evaluator.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>

#include "domains/interval/functions.h"
#include "lang/minibex/words.h"
#include "lang/model/type.h"
#include "lang/syntax/parser.h"

namespace hcsp::lang::minibex {

namespace {

// Loops in loops, and functions in functions, multiply: a file must not be able to fill the memory. What is
// written out may be as long as it is.
constexpr std::uint64_t kMostSteps = 5'000'000;
constexpr std::uint64_t kStepsOfWritten = 40;
constexpr std::uint32_t kDeepestEvaluation = 1000;

}  // namespace

const Binding* Scope::find(std::string_view name) const {
  for (const Scope* scope = this; scope != nullptr; scope = scope->around) {
    const auto found = scope->names.find(name);
    if (found != scope->names.end()) return &found->second;
  }
  return nullptr;
}

Evaluator::Evaluator(const Program& program, Problem& problem, Diagnostics& diagnostics)
    : program_(program),
      problem_(problem),
      diagnostics_(diagnostics),
      callable_(program.functions.size()),
      most_steps_(kMostSteps + kStepsOfWritten * program.expressions.size()) {
  for (std::size_t i = 0; i < program.functions.size(); ++i) {
    const Name& name = program.functions[i].name;
    if (!functions_.emplace(name.text, i).second)
      diagnostics_.report(Code::declared_twice, name.range, name.text);
  }
}

Tensor Evaluator::counted(int value) { return Term(*Number::parse(std::to_string(value))); }

// ---- Entries.

bool Evaluator::take_steps(const Expr& expr, std::uint64_t count) {
  if (steps_ >= most_steps_) return false;  // one report is enough
  steps_ += std::min(count, most_steps_);
  if (steps_ >= most_steps_) diagnostics_.report(Code::too_large, expr.range, kMostSteps);
  return steps_ < most_steps_;
}

Tensor Evaluator::value(const Expr& expr) {
  if (!take_steps(expr, 1)) return {};
  if (depth_ >= kDeepestEvaluation) {
    diagnostics_.report(Code::too_deep, expr.range, kDeepestNesting, kDeepestTree);
    steps_ = most_steps_;
    return {};
  }
  ++depth_;
  Tensor found = value_of_kind(expr);
  --depth_;
  return take_steps(expr, found.terms.size()) ? found : Tensor();
}

Tensor Evaluator::constant(const Expr& expr) {
  const bool outer = std::exchange(wants_constants_, true);
  if (!outer) made_of_intervals_ = false;
  Tensor found = value(expr);
  wants_constants_ = outer;
  return found;
}

std::optional<int> Evaluator::whole(const Expr& expr) {
  const Tensor found = constant(expr);
  if (found.failed()) return {};
  const auto value = found.is_scalar() ? whole_value(std::get<Number>(found.terms.front())) : std::nullopt;
  if (!value)
    diagnostics_.report(
        Code::wrong_type, expr.range, "a whole number",
        found.is_scalar() ? fmt::format("`{}`", expr.range.text().substr(0, 40)) : describe(found));
  return value;
}

std::optional<std::pair<std::size_t, std::size_t>> Evaluator::shape(const Declaration& declaration) {
  constexpr std::size_t kMostSizes = 2;
  std::array<std::size_t, kMostSizes> sizes{1, 1};
  if (declaration.sizes.size() > kMostSizes) {
    diagnostics_.report(Code::not_supported, declaration.sizes.back()->range, "an array of matrices");
    return {};
  }
  for (std::size_t i = 0; i < declaration.sizes.size(); ++i) {
    const auto size = whole(*declaration.sizes[i]);
    if (!size) return {};
    const auto most = static_cast<std::int64_t>(kMostComponents / sizes[0]);
    if (*size < 1 || *size > most) {
      diagnostics_.report(Code::bad_size, declaration.sizes[i]->range, most, *size);
      return {};
    }
    sizes[i] = static_cast<std::size_t>(*size);
  }
  return std::pair(sizes[0], sizes[1]);
}

// ---- Expressions.

Tensor Evaluator::value_of_kind(const Expr& expr) {
  switch (expr.kind) {
    case Kind::number:
      return number(expr);
    case Kind::name:
      return name(expr);
    case Kind::interval:
      return interval(expr);
    case Kind::ball:
      return ball(expr);
    case Kind::row:
    case Kind::column:
      return vector(expr);
    case Kind::negate:
      return negated(value(*expr.operands[0]));
    case Kind::transpose: {
      const Tensor operand = value(*expr.operands[0]);
      return operand.failed() ? Tensor() : transposed(operand);
    }
    case Kind::binary:
      return binary(expr);
    case Kind::apply:
      return apply(expr);
    case Kind::sum:
    case Kind::product:
      return over_range(expr);
    default:
      diagnostics_.report(Code::unexpected, expr.range, "an expression", "`:`");
      return {};
  }
}

Tensor Evaluator::number(const Expr& expr) {
  if (!expr.text.starts_with('#')) {
    const auto written = Number::parse(expr.text);
    return written ? Tensor(Term(*written)) : Tensor();  // what is no number the lexer has reported
  }
  std::uint64_t bits = 0;
  const char* end = expr.text.data() + expr.text.size();
  const auto [read, error] = std::from_chars(expr.text.data() + 1, end, bits, 16);
  const double value = std::bit_cast<double>(bits);
  if (error != std::errc() || read != end || !std::isfinite(value)) {
    diagnostics_.report(Code::malformed_number, expr.range, expr.text.substr(0, 40));
    return {};
  }
  return Term(Number::of(Interval(value)));
}

// What a name stands for here; null where it is not declared.
const Tensor* Evaluator::visible(const Expr& name) {
  const Binding* binding = scope_->find(name.text);
  if (binding == nullptr) return nullptr;
  if (!wants_constants_ || !binding->interval) return &binding->value;
  made_of_intervals_ = true;
  return &*binding->interval;
}

Tensor Evaluator::name(const Expr& expr) {
  if (const Tensor* found = visible(expr)) return as_wanted(expr, *found);
  if (expr.text == "pi") return Term(Number::of(pi(), "pi", {}));
  if (expr.text == "oo") {
    diagnostics_.report(Code::misplaced_infinity, expr.range);
    return {};
  }
  unknown_name(expr, Code::unknown_name);
  return {};
}

// Where a constant is wanted, unknowns are none.
Tensor Evaluator::as_wanted(const Expr& expr, Tensor tensor) {
  const auto is_number = [](const Term& term) { return std::holds_alternative<Number>(term); };
  if (!wants_constants_ || std::all_of(tensor.terms.begin(), tensor.terms.end(), is_number)) return tensor;
  diagnostics_.report(Code::not_constant, expr.range);
  return {};
}

bool Evaluator::is_new(const Name& name) {
  if (scope_->find(name.text) == nullptr) return true;
  diagnostics_.report(Code::declared_twice, name.range, name.text);
  return false;
}

void Evaluator::unknown_name(const Expr& name, Code code) {
  std::vector<std::string> candidates;
  for (const Scope* scope = scope_; scope != nullptr; scope = scope->around) {
    for (const auto& [known, binding] : scope->names) candidates.emplace_back(known);
  }
  for (const auto& [known, place] : functions_) candidates.emplace_back(known);
  for (const Word& word : words()) candidates.emplace_back(word.name);
  std::sort(candidates.begin(), candidates.end());
  auto& diagnostic = diagnostics_.report(code, name.range, name.text).did_you_mean(name.text, candidates);
  for (const Declaration& variable : program_.variables) {
    if (variable.name.text == name.text)
      diagnostic.note("variables are seen by the goal and the constraints alone");
  }
}

Tensor Evaluator::vector(const Expr& expr) {
  std::vector<Tensor> parts;
  for (const Expr* operand : expr.operands) {
    parts.push_back(value(*operand));
    if (parts.back().failed()) return {};
  }
  const bool side_by_side = expr.kind == Kind::row;
  if (auto found = joined(parts, side_by_side)) return std::move(*found);
  for (const Tensor& part : parts) {
    const bool fits = side_by_side ? part.rows == parts.front().rows : part.columns == parts.front().columns;
    if (fits) continue;
    diagnostics_.report(Code::wrong_operands, expr.range, side_by_side ? "," : ";", describe(parts.front()),
                        describe(part));
    break;
  }
  return {};
}

// A sum of thousands of terms is as deep to the left, and no recursion.
Tensor Evaluator::binary(const Expr& expr) {
  std::vector<const Expr*> chain;
  const Expr* first = &expr;
  for (; first->kind == Kind::binary; first = first->operands[0]) chain.push_back(first);
  Tensor left = value(*first);
  for (; !chain.empty() && !left.failed(); chain.pop_back()) {
    const Expr& link = *chain.back();
    const Tensor right = value(*link.operands[1]);
    if (right.failed()) return {};
    if (!take_steps(link, operations(link.op, left, right))) return {};
    auto found = combine(link.op, left, right);
    if (!found) {
      diagnostics_.report(Code::wrong_operands, link.token, link.token.text(), describe(left),
                          describe(right));
      return {};
    }
    left = defined(link, std::move(*found));
  }
  return left;
}

Tensor Evaluator::defined(const Expr& expr, Tensor tensor) {
  for (const Term& term : tensor.terms) {
    const auto* number = std::get_if<Number>(&term);
    if (number == nullptr || !number->enclosure.is_empty()) continue;
    diagnostics_.report(Code::undefined_constant, expr.range);
    return {};
  }
  return tensor;
}

Tensor Evaluator::over_range(const Expr& expr) {
  const Operator op = expr.kind == Kind::sum ? Operator::add : Operator::multiply;
  std::optional<Tensor> total;
  const bool good = for_each(*expr.operands[0], *expr.operands[1], {expr.text, expr.token}, [&] {
    Tensor term = value(*expr.operands[2]);
    if (term.failed()) return false;
    total = total ? combine(op, *total, term) : std::move(term);
    if (!total) diagnostics_.report(Code::wrong_operands, expr.range, spelling(op), "a part", "another");
    return total.has_value();
  });
  if (!good) return {};
  return total ? defined(expr, std::move(*total)) : counted(expr.kind == Kind::sum ? 0 : 1);
}

// ---- Intervals.

// A bound; none where it is infinite. An infinite bound on the wrong side is reported, and `infinite` false.
std::optional<Number> Evaluator::bound(const Expr& expr, bool& infinite, bool is_lower) {
  const bool is_negative = expr.kind == Kind::negate;
  const Expr& size = is_negative ? *expr.operands[0] : expr;
  infinite = size.kind == Kind::name && size.text == "oo" && scope_->find("oo") == nullptr;
  if (infinite) {
    if (is_negative == is_lower) return {};
    diagnostics_.report(Code::misplaced_infinity, expr.range);
    infinite = false;
    return {};
  }
  const Tensor found = constant(expr);
  if (found.failed()) return {};
  if (found.is_scalar()) return std::get<Number>(found.terms.front());
  diagnostics_.report(Code::wrong_type, expr.range, "a number", describe(found));
  return {};
}

std::optional<Bounds> Evaluator::bounds(const Expr& expr) {
  if (expr.kind != Kind::interval) {
    const Tensor found = constant(expr);
    if (found.failed()) return {};
    const Number& value = std::get<Number>(found.terms.front());
    if (!made_of_intervals_) return Bounds{value, value};
    const auto end = [](double at) {
      return std::isfinite(at) ? std::optional(Number::of(Interval(at))) : std::nullopt;
    };
    return Bounds{end(value.enclosure.lo()), end(value.enclosure.hi())};
  }
  bool from_infinity = false, to_infinity = false;
  Bounds found;
  found.lo = bound(*expr.operands[0], from_infinity, true);
  if (!found.lo && !from_infinity) return {};
  found.hi = bound(*expr.operands[1], to_infinity, false);
  if (!found.hi && !to_infinity) return {};
  if (found.lo && found.hi && known_relation(Operator::greater, *found.lo, *found.hi).value_or(false)) {
    diagnostics_.report(Code::empty_interval, expr.range);
    return {};
  }
  return found;
}

Tensor Evaluator::interval(const Expr& expr) {
  const auto found = bounds(expr);
  if (!found) return {};
  const bool is_point =
      found->lo && found->hi && known_relation(Operator::equal, *found->lo, *found->hi).value_or(false);
  if (is_point) return Term(*found->lo);
  return interval_constant(Interval(found->lo ? found->lo->enclosure.lo() : -kInfinity,
                                    found->hi ? found->hi->enclosure.hi() : kInfinity));
}

Tensor Evaluator::interval_constant(const Interval& value) {
  if (!wants_constants_) return Term(problem_.unknown_constant(value));
  made_of_intervals_ = true;
  return Term(Number::of(value));
}

Tensor Evaluator::ball(const Expr& expr) {
  const Tensor centre = constant(*expr.operands[0]);
  bool infinite = false;
  const auto radius = bound(*expr.operands[1], infinite, false);
  if (centre.failed() || (!radius && !infinite)) return {};
  const double r = radius ? radius->enclosure.hi() : kInfinity;
  if (r < 0) {
    diagnostics_.report(Code::empty_interval, expr.range);
    return {};
  }
  Tensor result(centre.rows, centre.columns, {});
  for (const Term& term : centre.terms) {
    const Interval around = std::get<Number>(term).enclosure + Interval(-r, r);
    result.terms.push_back(interval_constant(around).terms.front());
  }
  return result;
}

}  // namespace hcsp::lang::minibex
