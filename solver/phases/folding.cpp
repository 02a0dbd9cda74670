// SPDX-License-Identifier: Apache-2.0
#include "solver/phases/folding.h"

#include <algorithm>
#include <optional>
#include <set>

#include "solver/expression/operators.h"

namespace hcsp::folding {

namespace {

const DagNode& node_of(Expr a) { return a.dag()[a.node()]; }

// The value of two literals under an operation, where a double holds it.
template <class Operation>
std::optional<Expr> of_numbers(Expr a, Expr b, Operation operation) {
  const DagNode &x = node_of(a), &y = node_of(b);
  const bool are_numbers =
      x.op == Op::constant && y.op == Op::constant && x.value.is_point() && y.value.is_point();
  if (!are_numbers) return {};
  const Interval value = operation(x.value, y.value);
  if (!value.is_point()) return {};
  return Expr(a.dag(), a.dag().constant(value));
}

}  // namespace

bool is_number(Expr a, double value) {
  const DagNode& node = node_of(a);
  return node.op == Op::constant && node.value == Interval(value);
}

bool is_total(Expr a) { return node_of(a).is_total; }

Expr number(Dag& dag, double value) { return {dag, dag.constant(Interval(value))}; }

Expr sum(Expr a, Expr b) {
  if (is_number(a, 0.0)) return b;
  if (is_number(b, 0.0)) return a;
  const auto known = of_numbers(a, b, [](const Interval& x, const Interval& y) { return x + y; });
  return known ? *known : a + b;
}

Expr difference(Expr a, Expr b) {
  if (is_number(b, 0.0)) return a;
  if (is_number(a, 0.0)) return negated(b);
  if (a.node() == b.node() && is_total(a)) return number(a.dag(), 0.0);
  const auto known = of_numbers(a, b, [](const Interval& x, const Interval& y) { return x - y; });
  return known ? *known : a - b;
}

Expr product(Expr a, Expr b) {
  if (is_number(a, 1.0)) return b;
  if (is_number(b, 1.0)) return a;
  if (is_number(a, -1.0)) return negated(b);
  if (is_number(b, -1.0)) return negated(a);
  if (is_number(a, 0.0) && is_total(b)) return a;
  if (is_number(b, 0.0) && is_total(a)) return b;
  const auto known = of_numbers(a, b, [](const Interval& x, const Interval& y) { return x * y; });
  return known ? *known : a * b;
}

Expr negated(Expr a) {
  const DagNode& node = node_of(a);
  if (node.op == Op::constant && node.value.is_point()) return {a.dag(), a.dag().constant(-node.value)};
  if (node.op == Op::neg) return {a.dag(), node.operands[0]};
  return -a;
}

Expr quotient(Expr a, double divisor) {
  if (divisor == 1.0 || is_number(a, 0.0)) return a;
  const Expr by = number(a.dag(), divisor);
  const auto known = of_numbers(a, by, [](const Interval& x, const Interval& y) { return x / y; });
  return known ? *known : a / by;
}

Expr conjunction(Dag& dag, const std::vector<Expr>& relations) {
  std::set<NodeId> told;
  std::optional<Expr> all;
  for (const Expr& relation : relations) {
    const DagNode& node = node_of(relation);
    if (node.op == Op::constant && node.value == kTrue) continue;
    if (!told.insert(relation.node()).second) continue;
    all = all ? *all && relation : relation;
  }
  return all ? *all : Expr(dag, dag.constant(kTrue));
}

// Where it may be undefined, an equation that says no more would be taken for one that does.
Expr equality(Expr a, Expr b) {
  if (a.node() != b.node()) return a == b;
  if (is_total(a)) return {a.dag(), a.dag().constant(kTrue)};
  return abs(a) >= Interval(0.0);
}

}  // namespace hcsp::folding
