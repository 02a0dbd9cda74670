// SPDX-License-Identifier: Apache-2.0
// Arithmetic of expressions that leaves out what literal numbers make superfluous: 0 x is 0, x + 0 and 1 x
// are x, x - x is 0. An operand that may be undefined is never left out: a relation that it stands in is
// false there.
#pragma once

#include "solver/expression/expr.h"

namespace hcsp::folding {

/// Whether an expression is a literal, and this one.
bool is_number(Expr a, double value);
/// Whether it has a value wherever its unknowns are.
bool is_total(Expr a);

Expr number(Dag& dag, double value);
Expr sum(Expr a, Expr b);
Expr difference(Expr a, Expr b);
Expr product(Expr a, Expr b);
Expr negated(Expr a);
/// a divided by a literal that is not 0.
Expr quotient(Expr a, double divisor);

/// "All of them hold", each told once.
Expr conjunction(Dag& dag, const std::vector<Expr>& relations);
/// a == b: true where they are one expression that is always defined.
Expr equality(Expr a, Expr b);

}  // namespace hcsp::folding
