// SPDX-License-Identifier: Apache-2.0
// Expressions as a person writes them: x[0] * cos(x[1]) < 3. An Expr is a handle to a node of its constraint
// system's shared graph (dag.h), so that a common sub-expression is one node however often it is written.
#pragma once

#include <span>
#include <vector>

#include "solver/expression/dag.h"

namespace hcsp {

/// A real-valued or Boolean expression. A relation (<, ==, and, ...) is a Boolean expression; its values are
/// the subsets of {0, 1}. A relation is false where one of its terms is undefined.
class Expr {
 public:
  Expr(Dag& dag, NodeId node) : dag_(&dag), node_(node) {}
  [[nodiscard]] Dag& dag() const { return *dag_; }
  [[nodiscard]] NodeId node() const { return node_; }

 private:
  Dag* dag_;
  NodeId node_;
};

/// The general form: op applied to operands, all of one system. Throws std::invalid_argument on a wrong
/// count.
Expr operate(Op op, std::span<const Expr> operands);

Expr operator-(Expr a);
Expr operator+(Expr a, Expr b);
Expr operator-(Expr a, Expr b);
Expr operator*(Expr a, Expr b);
Expr operator/(Expr a, Expr b);
Expr sqr(Expr a);
Expr sqrt(Expr a);
Expr abs(Expr a);
Expr min(Expr a, Expr b);
Expr max(Expr a, Expr b);
Expr sin(Expr a);
Expr cos(Expr a);
Expr atan2(Expr y, Expr x);
Expr exp(Expr a);
Expr log(Expr a);
Expr tan(Expr a);
Expr asin(Expr a);
Expr acos(Expr a);
Expr atan(Expr a);
Expr sinh(Expr a);
Expr cosh(Expr a);
Expr tanh(Expr a);
Expr floor(Expr a);
Expr ceil(Expr a);
/// -1, 0 or 1.
Expr sign(Expr a);
/// a^n for any a; for a != 0 where n is negative.
Expr pown(Expr a, int n);
/// exp(b log a) for a > 0, and 0 for a == 0 and b > 0.
Expr pow(Expr a, Expr b);
/// The real n-th root, of a negative number for odd n only. Throws std::invalid_argument unless n >= 1.
Expr root(Expr a, int n);
Expr operator<(Expr a, Expr b);
Expr operator<=(Expr a, Expr b);
Expr operator>(Expr a, Expr b);
Expr operator>=(Expr a, Expr b);
Expr operator==(Expr a, Expr b);
Expr operator!=(Expr a, Expr b);
Expr operator&&(Expr a, Expr b);
Expr operator||(Expr a, Expr b);
Expr operator!(Expr a);
/// At least `count` of the relations hold; there is one at least.
Expr at_least(std::size_t count, const std::vector<Expr>& relations);
/// condition ? then : otherwise, for every value of the condition that is possible.
Expr if_then_else(Expr condition, Expr then, Expr otherwise);

// A constant beside an expression is a constant of that expression's system.
#define HCSP_WITH_CONSTANTS(op)                \
  Expr operator op(Expr a, const Interval& b); \
  Expr operator op(const Interval& a, Expr b);
HCSP_WITH_CONSTANTS(+)
HCSP_WITH_CONSTANTS(-)
HCSP_WITH_CONSTANTS(*)
HCSP_WITH_CONSTANTS(/)
HCSP_WITH_CONSTANTS(<)
HCSP_WITH_CONSTANTS(<=)
HCSP_WITH_CONSTANTS(>)
HCSP_WITH_CONSTANTS(>=)
HCSP_WITH_CONSTANTS(==)
HCSP_WITH_CONSTANTS(!=)
#undef HCSP_WITH_CONSTANTS

/// A vector of expressions: a tube's or vector's components, a point of space.
using VectorExpr = std::vector<Expr>;

VectorExpr operator+(const VectorExpr& a, const VectorExpr& b);
VectorExpr operator-(const VectorExpr& a, const VectorExpr& b);
VectorExpr operator*(Expr factor, const VectorExpr& a);
Expr dot(const VectorExpr& a, const VectorExpr& b);
/// The Euclidean norm sqrt(a1^2 + ... + an^2).
Expr norm(const VectorExpr& a);
/// Every component equal: a Boolean expression.
Expr operator==(const VectorExpr& a, const VectorExpr& b);

}  // namespace hcsp
