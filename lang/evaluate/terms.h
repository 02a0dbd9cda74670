// SPDX-License-Identifier: Apache-2.0
// Arithmetic of terms: numbers for as long as everything is known, expressions from then on. A constant that
// does not exist, 1/0 for one, has an empty enclosure.
#pragma once

#include "lang/evaluate/value.h"
#include "lang/model/built_in.h"
#include "lang/syntax/ast.h"
#include "solver/problem.h"

namespace hcsp::lang {

hcsp::Expr expression_of(Problem& problem, const Term& term);

Term negate(const Term& a);
/// + - * /
Term operate(Operator op, const Term& a, const Term& b);
/// A built-in function of one real, or of two: min, max, atan2.
Term scalar_function(BuiltIn function, const Term& a);
Term scalar_function(BuiltIn function, const Term& a, const Term& b);
Term power_of(const Term& base, int exponent);
/// By a whole number where the exponent is one.
Term power_of(const Term& base, const Term& exponent);
Term root_of(const Term& a, int degree);

// Of all components; of a sum and of an extremum there is one at least.
Term sum_of(const Value& terms);
Term product_of(const Value& terms);
Term extremum(BuiltIn function, const Value& terms);

// Matrices: components row after row.
Term dot(const Value& a, const Value& b);
/// `inner` is the number of a's columns and of b's rows, `columns` that of b's columns.
Value matrix_product(const Value& a, const Value& b, std::size_t inner, std::size_t columns);
Value transposed(const Value& a, std::size_t rows, std::size_t columns);

/// A comparison; of constants a constant, where their enclosures tell.
std::optional<bool> known_relation(Operator op, const Term& a, const Term& b);
hcsp::Expr compare(Operator op, const hcsp::Expr& a, const hcsp::Expr& b);

}  // namespace hcsp::lang
