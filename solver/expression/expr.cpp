// SPDX-License-Identifier: Apache-2.0
#include "solver/expression/expr.h"

#include "domains/check.h"
#include "solver/expression/operators.h"

namespace hcsp {

Expr operate(Op op, std::span<const Expr> operands) {
  require(!operands.empty() && operands.size() <= 3, "Expr: {} operands", operands.size());
  Dag& dag = operands.front().dag();
  std::array<NodeId, 3> nodes{};
  for (std::size_t k = 0; k < operands.size(); ++k) {
    require(&operands[k].dag() == &dag, "Expr: operand {} belongs to another problem", k);
    nodes[k] = operands[k].node();
  }
  return {dag, dag.apply(op, nodes, static_cast<int>(operands.size()))};
}

namespace {
Expr unary(Op op, Expr a) { return operate(op, std::array{a}); }
Expr binary(Op op, Expr a, Expr b) { return operate(op, std::array{a, b}); }
Expr constant_beside(Expr a, const Interval& value) { return {a.dag(), a.dag().constant(value)}; }

void require_same_size(const VectorExpr& a, const VectorExpr& b) {
  require(!a.empty() && a.size() == b.size(), "Expr: vectors of {} and {} components", a.size(), b.size());
}
}  // namespace

Expr operator-(Expr a) { return unary(Op::neg, a); }
Expr operator+(Expr a, Expr b) { return binary(Op::add, a, b); }
Expr operator-(Expr a, Expr b) { return binary(Op::sub, a, b); }
Expr operator*(Expr a, Expr b) { return binary(Op::mul, a, b); }
Expr operator/(Expr a, Expr b) { return binary(Op::div, a, b); }
Expr sqr(Expr a) { return unary(Op::sqr, a); }
Expr sqrt(Expr a) { return unary(Op::sqrt, a); }
Expr abs(Expr a) { return unary(Op::abs, a); }
Expr min(Expr a, Expr b) { return binary(Op::min, a, b); }
Expr max(Expr a, Expr b) { return binary(Op::max, a, b); }
Expr sin(Expr a) { return unary(Op::sin, a); }
Expr cos(Expr a) { return unary(Op::cos, a); }
Expr atan2(Expr y, Expr x) { return binary(Op::atan2, y, x); }
Expr exp(Expr a) { return unary(Op::exp, a); }
Expr log(Expr a) { return unary(Op::log, a); }
Expr tan(Expr a) { return unary(Op::tan, a); }
Expr asin(Expr a) { return unary(Op::asin, a); }
Expr acos(Expr a) { return unary(Op::acos, a); }
Expr atan(Expr a) { return unary(Op::atan, a); }
Expr sinh(Expr a) { return unary(Op::sinh, a); }
Expr cosh(Expr a) { return unary(Op::cosh, a); }
Expr tanh(Expr a) { return unary(Op::tanh, a); }
Expr floor(Expr a) { return unary(Op::floor, a); }
Expr ceil(Expr a) { return unary(Op::ceil, a); }
Expr sign(Expr a) { return unary(Op::sign, a); }
Expr pown(Expr a, int n) { return binary(Op::pown, a, constant_beside(a, Interval(n))); }
Expr pow(Expr a, Expr b) { return binary(Op::pow, a, b); }
Expr root(Expr a, int n) {
  require(n >= 1, "Expr: the {}-th root", n);
  return binary(Op::root, a, constant_beside(a, Interval(n)));
}
Expr operator<(Expr a, Expr b) { return binary(Op::less, a, b); }
Expr operator<=(Expr a, Expr b) { return binary(Op::less_equal, a, b); }
Expr operator>(Expr a, Expr b) { return binary(Op::less, b, a); }
Expr operator>=(Expr a, Expr b) { return binary(Op::less_equal, b, a); }
Expr operator==(Expr a, Expr b) { return binary(Op::equal, a, b); }
Expr operator!=(Expr a, Expr b) { return binary(Op::not_equal, a, b); }
Expr operator&&(Expr a, Expr b) { return binary(Op::logical_and, a, b); }
Expr operator||(Expr a, Expr b) { return binary(Op::logical_or, a, b); }
Expr operator!(Expr a) { return unary(Op::logical_not, a); }
Expr at_least(std::size_t count, const std::vector<Expr>& relations) {
  require(!relations.empty(), "Expr: a count of no relations");
  // Booleans are 0 and 1.
  Expr holding = relations.front();
  for (std::size_t i = 1; i < relations.size(); ++i) holding = holding + relations[i];
  return constant_beside(holding, Interval(static_cast<double>(count))) <= holding;
}
Expr if_then_else(Expr condition, Expr then, Expr otherwise) {
  return operate(Op::if_then_else, std::array{condition, then, otherwise});
}

#define HCSP_WITH_CONSTANTS(op)                                                      \
  Expr operator op(Expr a, const Interval& b) { return a op constant_beside(a, b); } \
  Expr operator op(const Interval& a, Expr b) { return constant_beside(b, a) op b; }
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

VectorExpr operator+(const VectorExpr& a, const VectorExpr& b) {
  require_same_size(a, b);
  VectorExpr sum;
  for (std::size_t i = 0; i < a.size(); ++i) sum.push_back(a[i] + b[i]);
  return sum;
}

VectorExpr operator-(const VectorExpr& a, const VectorExpr& b) {
  require_same_size(a, b);
  VectorExpr difference;
  for (std::size_t i = 0; i < a.size(); ++i) difference.push_back(a[i] - b[i]);
  return difference;
}

VectorExpr operator*(Expr factor, const VectorExpr& a) {
  VectorExpr product;
  for (const Expr& component : a) product.push_back(factor * component);
  return product;
}

Expr dot(const VectorExpr& a, const VectorExpr& b) {
  require_same_size(a, b);
  Expr sum = a[0] * b[0];
  for (std::size_t i = 1; i < a.size(); ++i) sum = sum + a[i] * b[i];
  return sum;
}

Expr norm(const VectorExpr& a) { return sqrt(dot(a, a)); }

Expr operator==(const VectorExpr& a, const VectorExpr& b) {
  require_same_size(a, b);
  Expr all = a[0] == b[0];
  for (std::size_t i = 1; i < a.size(); ++i) all = all && a[i] == b[i];
  return all;
}

}  // namespace hcsp
