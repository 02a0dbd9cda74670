// SPDX-License-Identifier: Apache-2.0
#include "solver/online/facts.h"

#include <algorithm>

#include "domains/rounding.h"
#include "solver/expression/operators.h"

namespace hcsp::online {

Facts::Facts(const Dag& dag, const Unknowns& unknowns)
    : dag_(dag), unknowns_(unknowns), words_(unknowns.domains.size() / 64 + 1), is_unknown_(words_) {
  for (const auto& [input, domain] : unknowns.domains) {
    const std::size_t place = inputs_.size();
    places_.emplace(input, place);
    inputs_.push_back(input);
    if (unknowns.is_unknown(input)) is_unknown_[place / 64] |= std::uint64_t{1} << (place % 64);
  }
}

// Operands precede what they are operands of.
void Facts::extend() {
  const RoundUpward guard;
  for (auto id = static_cast<NodeId>(ranges_.size()); id < dag_.size(); ++id) {
    const DagNode& node = dag_[id];
    supports_.resize(supports_.size() + words_);
    if (node.op == Op::input) {
      const std::size_t place = places_.at(node.input);
      support(id)[place / 64] |= std::uint64_t{1} << (place % 64);
      ranges_.push_back(unknowns_.domains.at(node.input));
    } else if (node.op == Op::constant) {
      ranges_.push_back(node.value);
    } else {
      const int arity = operator_entry(node.op).arity;
      const auto operand = [&](int k) { return node.operands[static_cast<std::size_t>(k < arity ? k : 0)]; };
      for (int k = 0; k < arity; ++k) {
        for (std::size_t w = 0; w < words_; ++w) support(id)[w] |= support(operand(k))[w];
      }
      ranges_.push_back(with_operator(node.op, [&](auto known) {
        return decltype(known)::type::forward(ranges_[operand(0)], ranges_[operand(1)], ranges_[operand(2)]);
      }));
    }
  }
}

bool Facts::needs(NodeId node, const Input& input) {
  extend();
  const std::size_t place = places_.at(input);
  return ((support(node)[place / 64] >> (place % 64)) & 1U) != 0;
}

bool Facts::is_given(NodeId node) {
  extend();
  for (std::size_t w = 0; w < words_; ++w) {
    if ((support(node)[w] & is_unknown_[w]) != 0) return false;
  }
  return true;
}

std::vector<Input> Facts::inputs_of(NodeId node) {
  extend();
  std::vector<Input> inputs;
  for (std::size_t place = 0; place < inputs_.size(); ++place) {
    if (((support(node)[place / 64] >> (place % 64)) & 1U) != 0) inputs.push_back(inputs_[place]);
  }
  return inputs;
}

Facts::Size Facts::size(NodeId node) {
  const auto [place, is_new] = sizes_.try_emplace(node);
  if (!is_new) return place->second;
  const std::vector<NodeId> needed = needed_nodes(dag_, {node});
  const auto open = std::count_if(needed.begin(), needed.end(), [&](NodeId id) { return !is_given(id); });
  return place->second = {needed.size(), static_cast<std::size_t>(open)};
}

const Interval& Facts::range(NodeId node) {
  extend();
  return ranges_[node];
}

namespace {

/// A node or its negation.
struct Signed {
  NodeId node;
  bool is_negated = false;

  [[nodiscard]] Interval range(Facts& facts) const {
    return is_negated ? -facts.range(node) : facts.range(node);
  }
  [[nodiscard]] Signed operand(const Dag& dag, std::size_t k) const {
    return {dag[node].operands[k], is_negated};
  }
  /// What it is below signs, and whether it is the least, or the greatest, of its operands.
  [[nodiscard]] Signed stripped(const Dag& dag) const {
    Signed of = *this;
    while (dag[of.node].op == Op::neg) of = {dag[of.node].operands[0], !of.is_negated};
    return of;
  }
  [[nodiscard]] bool is_least(const Dag& dag) const {
    return dag[node].op == (is_negated ? Op::max : Op::min);
  }
  [[nodiscard]] bool is_greatest(const Dag& dag) const {
    return dag[node].op == (is_negated ? Op::min : Op::max);
  }
};

bool at_most(const Dag& dag, const Signed& left, const Signed& right, Facts& facts, int depth) {
  const Signed a = left.stripped(dag), b = right.stripped(dag);
  if (a.node == b.node && a.is_negated == b.is_negated) return true;
  const Interval below = a.range(facts), above = b.range(facts);
  if (below.hi() <= above.lo()) return true;
  if (depth == 0) return false;
  const auto holds = [&](const Signed& p, const Signed& q) { return at_most(dag, p, q, facts, depth - 1); };
  const auto of_a = [&](std::size_t k) { return holds(a.operand(dag, k), b); };
  const auto of_b = [&](std::size_t k) { return holds(a, b.operand(dag, k)); };
  if (a.is_least(dag) && (of_a(0) || of_a(1))) return true;
  if (b.is_greatest(dag) && (of_b(0) || of_b(1))) return true;
  if (a.is_greatest(dag) && of_a(0) && of_a(1)) return true;
  if (b.is_least(dag) && of_b(0) && of_b(1)) return true;
  // p - q <= 0 where p <= q; 0 <= p - q where q <= p; with signs the other way round.
  const auto ordered = [&](NodeId difference, bool is_turned) {
    const auto [p, q, unused] = dag[difference].operands;
    return is_turned ? holds({q}, {p}) : holds({p}, {q});
  };
  if (dag[a.node].op == Op::sub && above.lo() >= 0.0 && ordered(a.node, a.is_negated)) return true;
  return dag[b.node].op == Op::sub && below.hi() <= 0.0 && ordered(b.node, !b.is_negated);
}

}  // namespace

bool is_at_most(const Dag& dag, NodeId a, NodeId b, Facts& facts) {
  constexpr int kDepth = 8;
  return at_most(dag, {a}, {b}, facts, kDepth);
}

}  // namespace hcsp::online
