// SPDX-License-Identifier: Apache-2.0
#include "lang/evaluate/terms.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "domains/interval/functions.h"

namespace hcsp::lang {

namespace {

constexpr int kMostExactFactors = 64;

/// A function of one real, of numbers and of expressions.
struct ScalarFunction {
  BuiltIn id;
  Interval (*of_number)(const Interval&);
  hcsp::Expr (*of_expression)(hcsp::Expr);
};

constexpr std::array kScalarFunctions{
#define HCSP_SCALAR(name) ScalarFunction{BuiltIn::name, hcsp::name, hcsp::name}
    HCSP_SCALAR(sqr),  HCSP_SCALAR(sqrt), HCSP_SCALAR(abs),  HCSP_SCALAR(exp),  HCSP_SCALAR(log),
    HCSP_SCALAR(sin),  HCSP_SCALAR(cos),  HCSP_SCALAR(tan),  HCSP_SCALAR(asin), HCSP_SCALAR(acos),
    HCSP_SCALAR(atan), HCSP_SCALAR(sinh), HCSP_SCALAR(cosh), HCSP_SCALAR(tanh), HCSP_SCALAR(floor),
    HCSP_SCALAR(ceil), HCSP_SCALAR(sign),
#undef HCSP_SCALAR
};

const Number* number_in(const Term& term) { return std::get_if<Number>(&term); }

/// A node that is the same for one number wherever it stands, and no other's.
NodeId constant_of(Dag& dag, const Number& number) {
  const bool is_known = number.enclosure.is_point() || number.identity() != 0;
  return is_known ? dag.constant(number.enclosure, number.identity()) : dag.own_constant(number.enclosure);
}

/// The operands as expressions; one of them is one already.
std::pair<hcsp::Expr, hcsp::Expr> expressions(const Term& a, const Term& b) {
  const auto lifted = [](const Term& term, Dag& dag) {
    const Number* number = number_in(term);
    return number == nullptr ? std::get<hcsp::Expr>(term) : hcsp::Expr(dag, constant_of(dag, *number));
  };
  Dag& dag = std::get<hcsp::Expr>(number_in(a) == nullptr ? a : b).dag();
  return {lifted(a, dag), lifted(b, dag)};
}

Term whole_power(const Term& base, int exponent) {
  if (exponent == 1) return base;
  if (exponent == 2) return scalar_function(BuiltIn::sqr, base);
  const Number* number = number_in(base);
  if (number == nullptr) return pown(std::get<hcsp::Expr>(base), exponent);
  const Number rounded =
      Number::of(pown(number->enclosure, exponent), "^", {*number, Number::of(Interval(exponent))});
  if (!number->exact || exponent < 0 || exponent > kMostExactFactors) return rounded;
  Number product = *Number::parse("1");
  for (int i = 0; i < exponent; ++i) product = product * *number;
  return product.exact ? product : rounded;
}

/// A whole exponent that no int holds: |x|^n, or x |x|^(n - 1) where n is odd.
Term large_power(const Term& base, const Number& exponent) {
  const Term size = scalar_function(BuiltIn::abs, base);
  if (!exponent.exact->is_odd()) return power_of(size, Number::of(exponent.enclosure, "large", {exponent}));
  const Number rest = exponent - *Number::parse("1");
  return operate(Operator::multiply, base, power_of(size, Number::of(rest.enclosure, "large", {rest})));
}

}  // namespace

hcsp::Expr expression_of(Problem& problem, const Term& term) {
  const Number* number = number_in(term);
  if (number == nullptr) return std::get<hcsp::Expr>(term);
  Dag& dag = problem.constant(Interval(0.0)).dag();
  return {dag, constant_of(dag, *number)};
}

std::optional<int> whole_value(const Number& number) {
  if (number.exact) return number.exact->as_int();
  const double value = number.enclosure.lo();
  const bool is_whole = number.enclosure.is_point() && value == std::floor(value) &&
                        std::abs(value) <= std::numeric_limits<int>::max();
  return is_whole ? std::optional(static_cast<int>(value)) : std::nullopt;
}

Term negate(const Term& a) {
  if (const Number* number = number_in(a)) return -*number;
  return -std::get<hcsp::Expr>(a);
}

Term operate(Operator op, const Term& a, const Term& b) {
  const auto apply = [op](const auto& x, const auto& y) -> Term {
    switch (op) {
      case Operator::add:
        return x + y;
      case Operator::subtract:
        return x - y;
      case Operator::multiply:
        return x * y;
      default:
        return x / y;
    }
  };
  if (number_in(a) != nullptr && number_in(b) != nullptr) return apply(*number_in(a), *number_in(b));
  const auto [u, v] = expressions(a, b);
  return apply(u, v);
}

Term scalar_function(BuiltIn function, const Term& a) {
  const auto& entry = *std::find_if(kScalarFunctions.begin(), kScalarFunctions.end(),
                                    [&](const ScalarFunction& known) { return known.id == function; });
  const Number* number = number_in(a);
  if (number == nullptr) return entry.of_expression(std::get<hcsp::Expr>(a));
  if (function == BuiltIn::sqr && number->exact) return *number * *number;
  return Number::of(entry.of_number(number->enclosure), fmt::format("f{}", static_cast<int>(function)),
                    {*number});
}

Term scalar_function(BuiltIn function, const Term& a, const Term& b) {
  const auto apply = [function](const auto& x, const auto& y) {
    switch (function) {
      case BuiltIn::min:
        return min(x, y);
      case BuiltIn::max:
        return max(x, y);
      default:
        return atan2(x, y);
    }
  };
  if (number_in(a) != nullptr && number_in(b) != nullptr)
    return Number::of(apply(number_in(a)->enclosure, number_in(b)->enclosure),
                      fmt::format("f{}", static_cast<int>(function)), {*number_in(a), *number_in(b)});
  const auto [u, v] = expressions(a, b);
  return apply(u, v);
}

Term root_of(const Term& a, int degree) {
  if (const Number* number = number_in(a))
    return Number::of(rootn(number->enclosure, degree), "root", {*number, Number::of(Interval(degree))});
  return root(std::get<hcsp::Expr>(a), degree);
}

Term power_of(const Term& base, const Term& exponent) {
  const Number* number = number_in(exponent);
  const auto whole = number != nullptr ? whole_value(*number) : std::nullopt;
  if (whole) return whole_power(base, *whole);
  if (number != nullptr && number->exact && number->exact->is_whole()) return large_power(base, *number);
  if (number != nullptr && number_in(base) != nullptr)
    return Number::of(pow(number_in(base)->enclosure, number->enclosure), "^", {*number_in(base), *number});
  if (number != nullptr && number->enclosure == Interval(0.5)) return scalar_function(BuiltIn::sqrt, base);
  const auto [u, v] = expressions(base, exponent);
  return pow(u, v);
}

Term sum_of(const Value& terms) {
  Term total = terms.front();
  for (std::size_t i = 1; i < terms.size(); ++i) total = operate(Operator::add, total, terms[i]);
  return total;
}

Term product_of(const Value& terms) {
  Term product = terms.empty() ? Term(*Number::parse("1")) : terms.front();
  for (std::size_t i = 1; i < terms.size(); ++i) product = operate(Operator::multiply, product, terms[i]);
  return product;
}

Term dot(const Value& a, const Value& b) {
  Value products;
  for (std::size_t i = 0; i < a.size(); ++i) products.push_back(operate(Operator::multiply, a[i], b[i]));
  return sum_of(products);
}

Term extremum(BuiltIn function, const Value& terms) {
  Term result = terms.front();
  for (std::size_t i = 1; i < terms.size(); ++i) result = scalar_function(function, result, terms[i]);
  return result;
}

Value matrix_product(const Value& a, const Value& b, std::size_t inner, std::size_t columns) {
  Value result;
  for (std::size_t row = 0; row < a.size() / inner; ++row) {
    const auto begin = a.begin() + static_cast<std::ptrdiff_t>(row * inner);
    const Value of_row(begin, begin + static_cast<std::ptrdiff_t>(inner));
    for (std::size_t column = 0; column < columns; ++column) {
      Value of_column;
      for (std::size_t k = 0; k < inner; ++k) of_column.push_back(b[k * columns + column]);
      result.push_back(dot(of_row, of_column));
    }
  }
  return result;
}

Value transposed(const Value& a, std::size_t rows, std::size_t columns) {
  Value result;
  for (std::size_t j = 0; j < columns; ++j) {
    for (std::size_t i = 0; i < rows; ++i) result.push_back(a[i * columns + j]);
  }
  return result;
}

std::optional<bool> known_relation(Operator op, const Term& a, const Term& b) {
  const Number* x = number_in(a);
  const Number* y = number_in(b);
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

}  // namespace hcsp::lang
