// SPDX-License-Identifier: Apache-2.0
// Calls: functions of the file, by substitution, and those that Minibex brings along.
#include <cmath>

#include "domains/interval/functions.h"
#include "lang/minibex/evaluator.h"
#include "lang/minibex/words.h"

namespace hcsp::lang::minibex {

namespace {

const Term kOne = *Number::parse("1");

Term plus(const Term& a, const Term& b) { return operate(Operator::add, a, b); }
Term minus(const Term& a, const Term& b) { return operate(Operator::subtract, a, b); }
Term times(const Term& a, const Term& b) { return operate(Operator::multiply, a, b); }
Term of(BuiltIn function, const Term& a) { return scalar_function(function, a); }

// The inverse hyperbolic functions by logarithms. A negative number is reflected: x + sqrt(x^2 + 1) cancels.
Term asinh(const Term& x) {
  const auto* number = std::get_if<Number>(&x);
  if (number != nullptr && number->enclosure.hi() < 0) return negate(asinh(negate(x)));
  return of(BuiltIn::log, plus(x, of(BuiltIn::sqrt, plus(of(BuiltIn::sqr, x), kOne))));
}
Term acosh(const Term& x) {
  return of(BuiltIn::log, plus(x, of(BuiltIn::sqrt, minus(of(BuiltIn::sqr, x), kOne))));
}
Term atanh(const Term& x) {
  return operate(Operator::divide, of(BuiltIn::log, operate(Operator::divide, plus(kOne, x), minus(kOne, x))),
                 *Number::parse("2"));
}

Tensor cross(const Value& a, const Value& b) {
  const auto component = [&](std::size_t i, std::size_t j) {
    return minus(times(a[i], b[j]), times(a[j], b[i]));
  };
  return {3, 1, {component(1, 2), component(2, 0), component(0, 1)}};
}

// IBEX's trace is the diagonal.
Tensor diagonal(const Tensor& a) {
  Tensor found(a.rows, 1, {});
  for (std::size_t i = 0; i < a.rows; ++i) found.terms.push_back(a.terms[i * a.columns + i]);
  return found;
}

bool takes_vectors(Word::Sense sense) { return sense == Word::Sense::cross || sense == Word::Sense::trace; }

}  // namespace

Tensor Evaluator::call(const Expr& expr) {
  const Expr& name = *expr.operands[0];
  const auto found = functions_.find(name.text);
  if (found != functions_.end() && found->second < callable_)
    return call_of(program_.functions[found->second], found->second, expr);
  if (found != functions_.end()) {
    const Code code = found->second == callable_ ? Code::recursion : Code::unknown_function;
    diagnostics_.report(code, name.range, name.text).note("a function can call those above it");
    return {};
  }
  return built_in(expr, name.text);
}

bool Evaluator::require_arguments(const Expr& expr, std::size_t fewest, std::size_t most,
                                  std::string_view what) {
  const std::size_t given = expr.operands.size() - 1;
  if (given >= fewest && given <= most) return true;
  const std::string taken = fewest == most   ? fmt::format("{} argument{}", most, most == 1 ? "" : "s")
                            : fewest > given ? fmt::format("{} arguments at least", fewest)
                                             : fmt::format("{} arguments at most", most);
  diagnostics_.report(Code::wrong_argument_count, expr.range, what, taken, given);
  return false;
}

Tensor Evaluator::call_of(const Function& function, std::size_t position, const Expr& expr) {
  const std::size_t count = function.arguments.size();
  if (!require_arguments(expr, count, count, function.name.text)) return {};
  Scope own{&constants_};
  for (std::size_t i = 0; i < count; ++i) {
    Tensor argument = value(*expr.operands[i + 1]);
    const auto wanted = argument.failed() ? std::nullopt : shape(function.arguments[i]);
    if (!wanted) return {};
    if (argument.rows != wanted->first || argument.columns != wanted->second) {
      diagnostics_.report(Code::wrong_type, expr.operands[i + 1]->range,
                          describe(Tensor(wanted->first, wanted->second, {})), describe(argument));
      return {};
    }
    own.names.insert_or_assign(function.arguments[i].name.text, Binding{std::move(argument), {}});
  }
  const std::size_t outer = std::exchange(callable_, position);
  Tensor result = within(own, [&] {
    for (const Definition& definition : function.definitions) {
      Tensor found = value(*definition.value);
      if (found.failed()) return Tensor();
      own.names.insert_or_assign(definition.name.text, Binding{std::move(found), {}});
    }
    return value(*function.result);
  });
  callable_ = outer;
  return result;
}

Tensor Evaluator::built_in(const Expr& expr, std::string_view name) {
  const Word* word = find_word(name);
  if (word == nullptr) {
    unknown_name(*expr.operands[0], Code::unknown_function);
    return {};
  }
  if (word->sense == Word::Sense::not_supported) {
    diagnostics_.report(Code::not_supported, expr.range, fmt::format("the function `{}`", name));
    return {};
  }
  if (!require_arguments(expr, word->fewest_arguments, word->most_arguments, name)) return {};
  if (word->sense == Word::Sense::end_of_interval) return end_of_interval(name, *expr.operands[1]);
  std::vector<Tensor> arguments;
  Value scalars;
  for (std::size_t i = 1; i < expr.operands.size(); ++i) {
    arguments.push_back(value(*expr.operands[i]));
    if (arguments.back().failed()) return {};
    scalars.push_back(arguments.back().terms.front());
    if (takes_vectors(word->sense) || arguments.back().is_scalar()) continue;
    diagnostics_.report(Code::wrong_type, expr.operands[i]->range, "a number", describe(arguments.back()));
    return {};
  }
  const Term& x = scalars.front();
  switch (word->sense) {
    case Word::Sense::scalar:
      return defined(expr, of(word->function, x));
    case Word::Sense::two_scalars:
      return defined(expr, scalar_function(word->function, x, scalars[1]));
    case Word::Sense::extremum:
      return extremum(word->function, scalars);
    case Word::Sense::power:
      return defined(expr, power_of(x, scalars[1]));
    case Word::Sense::chosen:
      return chosen(scalars);
    case Word::Sense::asinh:
      return asinh(x);
    case Word::Sense::acosh:
      return defined(expr, acosh(x));
    case Word::Sense::atanh:
      return defined(expr, atanh(x));
    case Word::Sense::sinc:
      return sinc(x);
    default:
      return of_vectors(expr, *word, arguments);
  }
}

Tensor Evaluator::of_vectors(const Expr& expr, const Word& word, const std::vector<Tensor>& arguments) {
  constexpr std::size_t kSpace = 3;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const Tensor& argument = arguments[i];
    const bool is_cross = word.sense == Word::Sense::cross;
    const bool fits = is_cross ? argument.is_vector() && argument.terms.size() == kSpace
                               : argument.rows == argument.columns;
    if (fits) continue;
    diagnostics_.report(Code::wrong_type, expr.operands[i + 1]->range,
                        is_cross ? "a vector of 3" : "a square matrix", describe(argument));
    return {};
  }
  if (word.sense == Word::Sense::trace) return diagonal(arguments.front());
  return cross(arguments[0].terms, arguments[1].terms);
}

// Where the sign of the first is not known, either, for every value that is possible.
Term Evaluator::chosen(const Value& arguments) {
  const Term zero = *Number::parse("0");
  if (const auto below = known_relation(Operator::less_equal, arguments[0], zero))
    return arguments[*below ? 1 : 2];
  if (wants_constants_)
    return Number::of(
        join(std::get<Number>(arguments[1]).enclosure, std::get<Number>(arguments[2]).enclosure));
  const auto expr = [&](const Term& term) { return expression_of(problem_, term); };
  const hcsp::Expr chosen =
      if_then_else(expr(arguments[0]) <= expr(zero), expr(arguments[1]), expr(arguments[2]));
  return chosen + expr(zero) * expr(arguments[0]);  // undefined where the first is
}

// sin(x)/x, and 1 at 0.
Term Evaluator::sinc(const Term& x) {
  const Term zero = *Number::parse("0");
  const auto quotient = [&] { return operate(Operator::divide, of(BuiltIn::sin, x), x); };
  if (const auto is_zero = known_relation(Operator::equal, x, zero)) return *is_zero ? kOne : quotient();
  if (std::holds_alternative<Number>(x)) return Number::of(Interval(-1.0, 1.0));
  const auto expr = [&](const Term& term) { return expression_of(problem_, term); };
  return if_then_else(expr(x) == expr(zero), expr(kOne), expr(quotient()));
}

// inf, mid and sup of a constant interval. A number is all of them.
Tensor Evaluator::end_of_interval(std::string_view name, const Expr& argument) {
  const Tensor found = constant(argument);
  if (found.failed()) return {};
  if (!found.is_scalar()) {
    diagnostics_.report(Code::wrong_type, argument.range, "a number", describe(found));
    return {};
  }
  const Number& number = std::get<Number>(found.terms.front());
  if (number.exact) return Term(number);
  const Interval& all = number.enclosure;
  const double end = name == "inf" ? all.lo() : name == "sup" ? all.hi() : all.mid();
  if (std::isfinite(end) && (name != "mid" || all.is_bounded())) return Term(Number::of(Interval(end)));
  diagnostics_.report(Code::misplaced_infinity, argument.range);
  return {};
}

}  // namespace hcsp::lang::minibex
