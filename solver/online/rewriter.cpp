// SPDX-License-Identifier: Apache-2.0
#include "solver/online/rewriter.h"

#include <algorithm>
#include <span>

#include "domains/rounding.h"
#include "solver/expression/operators.h"

namespace hcsp::online {

namespace {

bool is_leaf(Op op) { return op == Op::constant || op == Op::input; }

std::span<const NodeId> operands_of(const DagNode& node) {
  return {node.operands.data(), static_cast<std::size_t>(operator_entry(node.op).arity)};
}

// Choices between truths are truths.
bool is_truth(const Dag& dag, NodeId node) {
  const DagNode& of = dag[node];
  if (of.op != Op::if_then_else) return is_boolean(of.op);
  return is_truth(dag, of.operands[1]) || is_truth(dag, of.operands[2]);
}

Interval value_of(Op op, const Interval& a, const Interval& b, const Interval& c) {
  const RoundUpward guard;
  return with_operator(op, [&](auto known) { return decltype(known)::type::forward(a, b, c); });
}

bool is_defined_on(Op op, const Interval& a, const Interval& b, const Interval& c) {
  return with_operator(op, [&](auto known) { return decltype(known)::type::defined(a, b, c); });
}

/// One application, and the rules for it; kNone where no rule applies.
struct Folding {
  static constexpr NodeId kNone = ~NodeId{0};
  Dag& dag;
  NodeId a, b, c;
  std::vector<NodeId>* dropped;

  [[nodiscard]] NodeId number(double x) const { return dag.constant(Interval::raw(x, x)); }
  [[nodiscard]] bool is(NodeId node, double x) const { return is_number(dag, node, x); }
  [[nodiscard]] bool is_negation(NodeId node) const { return dag[node].op == Op::neg; }
  [[nodiscard]] NodeId make(Op op, NodeId x, NodeId y = 0, NodeId z = 0) const {
    return fold(dag, op, {x, y, z}, dropped);
  }
  [[nodiscard]] NodeId negated(NodeId node) const { return make(Op::neg, node); }
  [[nodiscard]] bool may_drop(NodeId node) const {
    if (dag[node].is_total) return true;
    if (dropped == nullptr) return false;
    dropped->push_back(node);
    return true;
  }
  [[nodiscard]] NodeId inner(NodeId node) const { return dag[node].operands[0]; }

  [[nodiscard]] NodeId sum() const {
    if (is(a, 0.0)) return b;
    if (is(b, 0.0)) return a;
    if (is_negation(b)) return make(Op::sub, a, inner(b), 0);
    if (is_negation(a)) return make(Op::sub, b, inner(a), 0);
    return kNone;
  }
  [[nodiscard]] NodeId difference() const {
    if (is(b, 0.0)) return a;
    if (is(a, 0.0)) return negated(b);
    if (a == b && may_drop(a)) return number(0.0);
    if (is_negation(b)) return make(Op::add, a, inner(b), 0);
    return of_extremum();
  }
  // max(x, y) - x is not negative, by form.
  [[nodiscard]] NodeId of_extremum() const {
    const auto other = [&](NodeId extremum, NodeId one) {
      const DagNode& node = dag[extremum];
      if (node.op != Op::min && node.op != Op::max) return kNone;
      return node.operands[0] == one ? node.operands[1] : node.operands[1] == one ? node.operands[0] : kNone;
    };
    const NodeId x = other(a, b), y = other(b, a);
    if (x != kNone) return make(dag[a].op, make(Op::sub, x, b), number(0.0));
    if (y == kNone) return kNone;
    return make(dag[b].op == Op::min ? Op::max : Op::min, make(Op::sub, a, y), number(0.0));
  }
  [[nodiscard]] NodeId product() const {
    if (is(a, 1.0)) return b;
    if (is(b, 1.0)) return a;
    if (is(a, -1.0)) return negated(b);
    if (is(b, -1.0)) return negated(a);
    if (is(a, 0.0) && may_drop(b)) return a;
    if (is(b, 0.0) && may_drop(a)) return b;
    if (is_negation(a) && is_negation(b)) return make(Op::mul, inner(a), inner(b), 0);
    if (is_negation(a)) return negated(make(Op::mul, inner(a), b, 0));
    if (is_negation(b)) return negated(make(Op::mul, a, inner(b), 0));
    return kNone;
  }
  [[nodiscard]] NodeId quotient() const {
    if (is(b, 1.0)) return a;
    if (is(b, -1.0)) return negated(a);
    return kNone;
  }
  [[nodiscard]] NodeId conjunction(double neutral) const {
    if (is(a, neutral)) return b;
    if (is(b, neutral)) return a;
    if (is(a, 1.0 - neutral) || is(b, 1.0 - neutral)) return number(1.0 - neutral);
    return a == b ? a : kNone;
  }
  // Between choices by one condition, a relation is the choice of two relations' sides.
  [[nodiscard]] NodeId choice() const {
    if (is(a, 1.0)) return b;
    if (is(a, 0.0)) return c;
    if (b == c) return b;
    const DagNode x = dag[b], y = dag[c];
    if (x.op != y.op || !is_relation(x.op)) return kNone;
    const auto side = [&](std::size_t k) { return make(Op::if_then_else, a, x.operands[k], y.operands[k]); };
    return make(x.op, side(0), side(1), 0);
  }

  [[nodiscard]] NodeId of(Op op) const {
    switch (op) {
      case Op::neg:
        return is_negation(a) ? inner(a) : kNone;
      case Op::add:
        return sum();
      case Op::sub:
        return difference();
      case Op::mul:
        return product();
      case Op::div:
        return quotient();
      case Op::min:
      case Op::max:
        return a == b ? a : kNone;
      case Op::sqr:
      case Op::abs:
        return is_negation(a) ? make(op, inner(a), 0, 0) : kNone;
      case Op::less_equal:
      case Op::equal:
        return a == b && may_drop(a) ? number(1.0) : kNone;
      case Op::less:
      case Op::not_equal:
        return a == b ? number(0.0) : kNone;
      case Op::logical_and:
        return conjunction(1.0);
      case Op::logical_or:
        return conjunction(0.0);
      case Op::logical_not:
        return dag[a].op == Op::logical_not ? inner(a) : kNone;
      case Op::if_then_else:
        return choice();
      default:
        return kNone;
    }
  }
};

}  // namespace

NodeId copy_constant(const DagNode& constant, Dag& to) {
  const std::uint64_t origin = constant.input.component | std::uint64_t{constant.input.gate} << 32;
  return to.constant(constant.value, origin);
}

bool is_number(const Dag& dag, NodeId node) {
  return dag[node].op == Op::constant && dag[node].value.is_point();
}

bool is_number(const Dag& dag, NodeId node, double value) {
  return is_number(dag, node) && dag[node].value.lo() == value;
}

NodeId fold(Dag& dag, Op op, std::array<NodeId, 3> operands, std::vector<NodeId>* dropped) {
  const int arity = operator_entry(op).arity;
  const auto [a, b, c] = operands;
  bool are_numbers = true;
  for (int k = 0; k < arity; ++k)
    are_numbers = are_numbers && is_number(dag, operands[static_cast<std::size_t>(k)]);
  if (are_numbers) {
    const auto operand = [&](int k) {
      return dag[operands[static_cast<std::size_t>(k < arity ? k : 0)]].value;
    };
    const Interval value = value_of(op, operand(0), operand(1), operand(2));
    if (value.is_point() && value.is_bounded() && is_defined_on(op, operand(0), operand(1), operand(2)))
      return dag.constant(value);
  }
  const NodeId folded = Folding{dag, a, b, c, dropped}.of(op);
  return folded != Folding::kNone ? folded : dag.apply(op, operands, arity);
}

NodeId Rewriter::copy_leaf(NodeId node) {
  const DagNode leaf = from_[node];
  if (&from_ == &to_) return node;
  // Constants with the same bounds may be different numbers: each keeps a name of its own.
  return leaf.op == Op::input ? to_.input(leaf.input) : to_.constant(leaf.value, std::uint64_t{node} + 1);
}

NodeId Rewriter::operator()(NodeId node) {
  if (const NodeId* known = known_.find(node)) return *known;
  if (facts_ != nullptr && !facts_->needs(node, input_)) return node;
  const DagNode copy = from_[node];
  NodeId result{};
  if (is_leaf(copy.op)) {
    result = copy_leaf(node);
  } else {
    std::array<NodeId, 3> operands{};
    bool is_same = &from_ == &to_;
    for (std::size_t k = 0; k < operands_of(copy).size(); ++k) {
      const bool is_joined =
          copy.op == Op::logical_and || copy.op == Op::logical_or || (copy.op == Op::if_then_else && k > 0);
      const bool is_left = careful_ != nullptr && !is_joined && is_truth(from_, copy.operands[k]);
      operands[k] = is_left ? (*careful_)(copy.operands[k]) : (*this)(copy.operands[k]);
      is_same = is_same && operands[k] == copy.operands[k];
    }
    result = is_same ? node : fold(to_, copy.op, operands, dropped_);
  }
  known_.set(node, result);
  return result;
}

}  // namespace hcsp::online
