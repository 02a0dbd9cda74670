// SPDX-License-Identifier: Apache-2.0
// Matrices: components row after row.
#include <bit>

#include "lang/evaluate/evaluator.h"

namespace hcsp::lang {

// A vector is a row on the left and a column on the right.
Value Evaluator::product(const Expr& expr, const Value& a, const Value& b) {
  const Type &of_a = model_.type(*expr.operands[0]), &of_b = model_.type(*expr.operands[1]);
  const std::size_t inner = of_a.is_matrix() ? of_a.columns : of_a.dim;
  const std::size_t columns = std::max(of_b.columns, 1U);
  for (std::size_t entry = 0; entry < a.size() / inner * columns; ++entry) {
    if (!take_step(expr)) return {};
  }
  return defined(expr, matrix_product(a, b, inner, columns));
}

namespace {

/// A square matrix without one row and one column.
Value minor_of(const Value& a, std::size_t n, std::size_t row, std::size_t column) {
  Value minor;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      if (i != row && j != column) minor.push_back(a[i * n + j]);
    }
  }
  return minor;
}

}  // namespace

// By rows from the last: the determinant of the last k rows and any k columns comes from those of k - 1 of
// them, each of which is computed once.
Term Evaluator::determinant(const Value& a, std::size_t n) {
  std::vector<Term> of_columns(std::size_t{1} << n, *Number::parse("1"));  // by set of columns
  for (std::size_t columns = 1; columns < of_columns.size(); ++columns) {
    const std::size_t row = n - static_cast<std::size_t>(std::popcount(columns));
    Value terms;
    for (std::size_t column = 0; column < n; ++column) {
      if ((columns >> column & 1U) == 0) continue;
      const Term term =
          operate(Operator::multiply, a[row * n + column], of_columns[columns & ~(std::size_t{1} << column)]);
      terms.push_back(terms.size() % 2 == 0 ? term : negate(term));
    }
    of_columns[columns] = sum_of(terms);
  }
  return of_columns.back();
}

// The transposed cofactors over the determinant.
Value Evaluator::inverse(const Value& a, std::size_t n) {
  const Term whole = determinant(a, n);
  Value result;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const Term cofactor = determinant(minor_of(a, n, j, i), n - 1);
      result.push_back(operate(Operator::divide, (i + j) % 2 == 0 ? cofactor : negate(cofactor), whole));
    }
  }
  return result;
}

// In the plane, counterclockwise; in space about an axis of any length by Rodrigues' formula.
Value Evaluator::rotation(const std::vector<Value>& arguments) {
  const Term& angle = arguments.back().front();
  const Term c = scalar_function(BuiltIn::cos, angle), s = scalar_function(BuiltIn::sin, angle);
  if (arguments.size() == 1) return {c, negate(s), s, c};
  const Value& axis = arguments.front();
  Value squares;
  for (const Term& component : axis) squares.push_back(scalar_function(BuiltIn::sqr, component));
  const Term length = scalar_function(BuiltIn::sqrt, sum_of(squares));
  Value unit;
  for (const Term& component : axis) unit.push_back(operate(Operator::divide, component, length));
  const Term rest = operate(Operator::subtract, *Number::parse("1"), c);
  Value result;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const Term both = operate(Operator::multiply, operate(Operator::multiply, unit[i], unit[j]), rest);
      if (i == j) {
        result.push_back(operate(Operator::add, both, c));
        continue;
      }
      const Term turn = operate(Operator::multiply, unit[3 - i - j], s);
      result.push_back(operate((j + 3 - i) % 3 == 2 ? Operator::add : Operator::subtract, both, turn));
    }
  }
  return result;
}

Value Evaluator::matrix_function(const Expr& expr, BuiltIn function, const std::vector<Value>& arguments) {
  const Value& a = arguments.front();
  const Type& type = model_.type(*expr.operands[1]);
  const std::size_t n = type.dim;
  switch (function) {
    case BuiltIn::cross: {
      const Value& b = arguments[1];
      const auto component = [&](std::size_t i, std::size_t j) {
        return operate(Operator::subtract, operate(Operator::multiply, a[i], b[j]),
                       operate(Operator::multiply, a[j], b[i]));
      };
      if (n == 2) return {component(0, 1)};
      return {component(1, 2), component(2, 0), component(0, 1)};
    }
    case BuiltIn::transpose:
      return transposed(a, n, type.columns);
    case BuiltIn::det:
      return defined(expr, {determinant(a, n)});
    case BuiltIn::inverse:
      return defined(expr, inverse(a, n));
    case BuiltIn::zeros:
      return Value(model_.type(expr).terms(), *Number::parse("0"));
    default:
      return defined(expr, rotation(arguments));
  }
}

}  // namespace hcsp::lang
