// SPDX-License-Identifier: Apache-2.0
#include "solver/online/facts.h"

#include <algorithm>
#include <span>

#include "domains/rounding.h"
#include "solver/expression/operators.h"
#include "solver/online/truth.h"

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

namespace {

std::span<const NodeId> operands_of(const DagNode& node) {
  return {node.operands.data(), static_cast<std::size_t>(operator_entry(node.op).arity)};
}

}  // namespace

// Operands precede what they are operands of.
void Facts::extend() {
  const auto first = static_cast<NodeId>(supports_.size() / words_);
  supports_.resize(dag_.size() * words_);
  for (NodeId id = first; id < dag_.size(); ++id) {
    const DagNode& node = dag_[id];
    if (node.op == Op::input) {
      const std::size_t place = places_.at(node.input);
      support(id)[place / 64] |= std::uint64_t{1} << (place % 64);
    }
    for (const NodeId operand : operands_of(node)) {
      for (std::size_t w = 0; w < words_; ++w) support(id)[w] |= support(operand)[w];
    }
  }
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

// f(node) of a node and of all that it needs, once each, for as long as f wants what a node needs.
template <class F>
void Facts::for_each_part(NodeId node, F f) {
  marks_.resize(dag_.size());
  ++mark_;
  const auto visit = [&](NodeId id) {
    if (marks_[id] == mark_) return;
    marks_[id] = mark_;
    if (f(id)) open_.push_back(id);
  };
  visit(node);
  while (!open_.empty()) {
    const NodeId id = open_.back();
    open_.pop_back();
    for (const NodeId operand : operands_of(dag_[id])) visit(operand);
  }
}

Facts::Size Facts::size(NodeId node) {
  const auto [place, is_new] = sizes_.try_emplace(node);
  if (!is_new) return place->second;
  Size size{0, 0};
  for_each_part(node, [&](NodeId id) {
    ++size.nodes;
    if (!is_given(id)) ++size.open;
    return true;
  });
  return place->second = size;
}

bool Facts::is_part(NodeId part, NodeId of) {
  bool is_found = false;
  for_each_part(of, [&](NodeId id) {
    is_found = is_found || id == part;
    return !is_found && id > part;
  });
  return is_found;
}

Interval Facts::range(NodeId node) {
  ranges_.resize(dag_.size());
  has_range_.resize(dag_.size());
  is_defined_.resize(dag_.size(), 1);
  if (has_range_[node] != 0) return ranges_[node];
  const RoundUpward guard;
  std::vector<NodeId> parts;
  for_each_part(node, [&](NodeId id) {
    if (has_range_[id] == 0) parts.push_back(id);
    return has_range_[id] == 0;
  });
  std::sort(parts.begin(), parts.end());
  for (const NodeId id : parts) {
    find_range(id);
    has_range_[id] = 1;
  }
  return ranges_[node];
}

void Facts::find_range(NodeId id) {
  const DagNode& node = dag_[id];
  if (node.op == Op::input) ranges_[id] = unknowns_.domains.at(node.input);
  if (node.op == Op::constant) ranges_[id] = node.value;
  const std::span<const NodeId> operands = operands_of(node);
  if (operands.empty()) return;
  const auto range = [&](std::size_t k) { return ranges_[operands[k < operands.size() ? k : 0]]; };
  const Interval a = range(0), b = range(1), c = range(2);
  const auto [y, is_defined] = with_operator(node.op, [&](auto known) {
    using Operator = typename decltype(known)::type;
    return std::pair(Operator::forward(a, b, c), Operator::defined(a, b, c));
  });
  // Of a choice that is decided the branch that is not taken need not be.
  const NodeId untaken = node.op != Op::if_then_else ? id
                         : operators::is_true(a)     ? operands[2]
                         : operators::is_false(a)    ? operands[1]
                                                     : id;
  const bool are_defined = std::all_of(operands.begin(), operands.end(), [&](NodeId operand) {
    return operand == untaken || is_defined_[operand] != 0;
  });
  ranges_[id] = is_relation(node.op) ? truth(y, a, b, are_defined) : y;
  is_defined_[id] = is_boolean(node.op) || (are_defined && is_defined) ? 1 : 0;
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
