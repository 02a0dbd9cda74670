// SPDX-License-Identifier: Apache-2.0
// What an expression means at a point, told by a plain recursion on its graph that shares nothing with
// programs but Interval: a term has a value or none; a relation is false where a term has none. And random
// relations to try it on.
#pragma once

#include <map>
#include <vector>

#include "solver/expression/expr.h"
#include "solver/expression/operators.h"
#include "tests/support/oracle.h"

namespace hcsp::oracle {

class Pointwise {
 public:
  Pointwise(const Dag& dag, std::map<Input, double> point) : dag_(dag), point_(std::move(point)) {}

  /// Whether a Boolean node holds.
  [[nodiscard]] Answer holds(NodeId id) const {
    const DagNode& node = dag_[id];
    switch (node.op) {
      case Op::logical_not:
        return inverse(holds(node.operands[0]));
      case Op::logical_and:
        return std::min(holds(node.operands[0]), holds(node.operands[1]));
      case Op::logical_or:
        return std::max(holds(node.operands[0]), holds(node.operands[1]));
      default:
        return relation(node);
    }
  }

  /// A term: whether it has a value, and an enclosure of it.
  struct Term {
    Answer defined = Answer::yes;
    Interval value;
  };

  [[nodiscard]] Term term(NodeId id) const {
    const DagNode& node = dag_[id];
    if (node.op == Op::constant) return {Answer::yes, node.value};
    if (node.op == Op::input) return {Answer::yes, Interval(point_.at(node.input))};
    if (node.op == Op::if_then_else) return choice(node);
    Term a = term(node.operands[0]);
    if (operator_entry(node.op).arity == 1)
      return {std::min(a.defined, domain_of(node.op, a.value, a.value)), unary(node.op, a.value)};
    Term b = term(node.operands[1]);
    const Answer defined = std::min({a.defined, b.defined, domain_of(node.op, a.value, b.value)});
    return {defined, binary(node.op, a.value, b.value)};
  }

 private:
  static Answer inverse(Answer a) {
    return a == Answer::yes ? Answer::no : (a == Answer::no ? Answer::yes : a);
  }
  static Answer known(bool yes, bool no) { return yes ? Answer::yes : (no ? Answer::no : Answer::unsure); }

  [[nodiscard]] Term choice(const DagNode& node) const {
    const Answer condition = holds(node.operands[0]);
    if (condition == Answer::yes) return term(node.operands[1]);
    if (condition == Answer::no) return term(node.operands[2]);
    return {Answer::unsure, Interval::entire()};
  }

  static Answer domain_of(Op op, const Interval& a, const Interval& b) {
    if (a.is_empty() || b.is_empty()) return Answer::no;
    switch (op) {
      case Op::sqrt:
        return known(a.lo() >= 0, a.hi() < 0);
      case Op::div:
        return known(!b.contains(0), b == Interval(0));
      case Op::atan2:
        return known(!a.contains(0) || !b.contains(0), a == Interval(0) && b == Interval(0));
      default:
        return Answer::yes;
    }
  }

  static Interval unary(Op op, const Interval& a) {
    switch (op) {
      case Op::neg:
        return -a;
      case Op::sqr:
        return hcsp::sqr(a);
      case Op::sqrt:
        return hcsp::sqrt(a);
      case Op::abs:
        return hcsp::abs(a);
      case Op::sin:
        return hcsp::sin(a);
      case Op::cos:
        return hcsp::cos(a);
      default:
        throw std::logic_error("no unary operator");
    }
  }

  static Interval binary(Op op, const Interval& a, const Interval& b) {
    switch (op) {
      case Op::add:
        return a + b;
      case Op::sub:
        return a - b;
      case Op::mul:
        return a * b;
      case Op::div:
        return a / b;
      case Op::min:
        return hcsp::min(a, b);
      case Op::max:
        return hcsp::max(a, b);
      case Op::atan2:
        return hcsp::atan2(a, b);
      default:
        throw std::logic_error("no binary operator");
    }
  }

  [[nodiscard]] Answer relation(const DagNode& node) const {
    const Term left = term(node.operands[0]), right = term(node.operands[1]);
    const Answer defined = std::min(left.defined, right.defined);
    const Interval &a = left.value, &b = right.value;
    if (defined == Answer::no || a.is_empty() || b.is_empty()) return Answer::no;
    const bool same = a.is_point() && a == b, apart = meet(a, b).is_empty();
    switch (node.op) {
      case Op::less:
        return std::min(defined, known(a.hi() < b.lo(), a.lo() >= b.hi()));
      case Op::less_equal:
        return std::min(defined, known(a.hi() <= b.lo(), a.lo() > b.hi()));
      case Op::equal:
        return std::min(defined, known(same, apart));
      default:
        return std::min(defined, known(apart, same));
    }
  }

  const Dag& dag_;
  std::map<Input, double> point_;
};

/// A random term over some leaves.
inline Expr random_term(Dice& dice, const std::vector<Expr>& leaves, int depth);

inline Expr random_relation(Dice& dice, const std::vector<Expr>& leaves, int depth) {
  if (depth > 1 && dice.below(3) == 0) {
    const Expr a = random_relation(dice, leaves, depth - 1);
    if (dice.below(4) == 0) return !a;
    const Expr b = random_relation(dice, leaves, depth - 1);
    return dice.below(2) == 0 ? (a && b) : (a || b);
  }
  const Expr a = random_term(dice, leaves, depth),
             b = random_term(dice, leaves, dice.below(std::max(depth, 1)));
  switch (dice.below(6)) {
    case 0:
      return a == b;
    case 1:
      return a != b;
    case 2:
      return a <= b;
    default:
      return a < b;
  }
}

inline Expr random_term(Dice& dice, const std::vector<Expr>& leaves, int depth) {
  if (depth <= 0 || dice.below(6) == 0) {
    const Expr leaf = leaves[static_cast<std::size_t>(dice.below(static_cast<int>(leaves.size())))];
    if (dice.below(4) != 0) return leaf;
    return {leaf.dag(), leaf.dag().constant(Interval(dyadic(dice, -3, 3, 1)))};
  }
  const Expr a = random_term(dice, leaves, depth - 1);
  switch (dice.below(13)) {
    case 0:
      return -a;
    case 1:
      return sqr(a);
    case 2:
      return sqrt(a);
    case 3:
      return abs(a);
    case 4:
      return dice.below(2) == 0 ? sin(a) : cos(a);
    default:
      break;
  }
  const Expr b = random_term(dice, leaves, depth - 1);
  switch (dice.below(8)) {
    case 0:
      return a + b;
    case 1:
      return a - b;
    case 2:
      return a * b;
    case 3:
      return a / b;
    case 4:
      return min(a, b);
    case 5:
      return max(a, b);
    case 6:
      return atan2(a, b);
    default:
      return if_then_else(random_relation(dice, leaves, depth - 1), a, b);
  }
}

}  // namespace hcsp::oracle
