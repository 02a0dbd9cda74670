// SPDX-License-Identifier: Apache-2.0
// What can be done with terms, in whichever language they were written: numbers are computed with for as long
// as everything is known, exactly while decimals fit, and expressions of a Problem are built from then on.
// The expressions among the operands belong to one Problem. A constant that does not exist is an empty
// number.
#pragma once

#include <optional>

#include "lang/evaluate/value.h"
#include "lang/model/built_in.h"
#include "lang/syntax/ast.h"
#include "solver/problem.h"

namespace hcsp::lang {

/// A constant of the Problem, where the term is a number.
hcsp::Expr expression_of(Problem& problem, const Term& term);

/// The value if it is known to be a whole number, one that an int can hold.
std::optional<int> whole_value(const Number& number);

Term negate(const Term& a);
/// One of + - * /.
Term operate(Operator op, const Term& a, const Term& b);
/// A built-in function of one real: sqr to sign.
Term scalar_function(BuiltIn function, const Term& a);
/// min, max or atan2.
Term scalar_function(BuiltIn function, const Term& a, const Term& b);
/// The real root of a degree of at least 1.
Term root_of(const Term& a, int degree);
/// A whole exponent, by its value, is one of repeated products, a half that of the root; any other is
/// exp(exponent*log(base)).
Term power_of(const Term& base, const Term& exponent);
Term sum_of(const Value& terms);      ///< of one term at least
Term product_of(const Value& terms);  ///< 1 of none
Term dot(const Value& a, const Value& b);
/// The min or max of one term at least.
Term extremum(BuiltIn function, const Value& terms);

// Matrices, their components row after row.
/// The product of a matrix with rows of `inner` components and one with rows of `columns`.
Value matrix_product(const Value& a, const Value& b, std::size_t inner, std::size_t columns);
Value transposed(const Value& a, std::size_t rows, std::size_t columns);

/// How a comparison of constants ends, where their enclosures tell.
std::optional<bool> known_relation(Operator op, const Term& a, const Term& b);
hcsp::Expr compare(Operator op, const hcsp::Expr& a, const hcsp::Expr& b);

}  // namespace hcsp::lang
