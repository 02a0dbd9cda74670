// SPDX-License-Identifier: Apache-2.0
#include "solver/expression/dag.h"

#include <algorithm>
#include <unordered_set>

#include "domains/check.h"
#include "solver/expression/operators.h"

namespace hcsp {

NodeId Dag::intern(const DagNode& node) {
  const Key key{node.op, node.operands, node.value.lo(), node.value.hi(), node.input};
  const auto [place, added] = known_.try_emplace(key, static_cast<NodeId>(nodes_.size()));
  if (added) nodes_.push_back(node);
  return place->second;
}

NodeId Dag::constant(const Interval& value, std::uint64_t origin) {
  DagNode node;
  node.value = value;
  // A number that is known exactly is what it is, wherever it comes from.
  if (!value.is_point())
    node.input = {{}, 0, static_cast<std::uint32_t>(origin), static_cast<std::uint32_t>(origin >> 32)};
  return intern(node);
}

NodeId Dag::own_constant(const Interval& value) {
  DagNode node;
  node.value = value;
  node.input = {{}, 1, ++own_constants_, 0};  // only to tell it from others
  return intern(node);
}

NodeId Dag::input(const Input& input) {
  DagNode node;
  node.op = Op::input;
  node.input = input;
  return intern(node);
}

NodeId Dag::apply(Op op, std::array<NodeId, 3> operands, int count) {
  const OperatorEntry& entry = operator_entry(op);
  require(entry.arity == count && count > 0, "Dag: the operator {} takes {} operands, not {}", entry.name,
          entry.arity, count);
  for (int k = 0; k < count; ++k) {
    require(operands[static_cast<std::size_t>(k)] < nodes_.size(), "Dag: operand {} is not a node", k);
  }
  std::fill(operands.begin() + count, operands.end(), NodeId{0});
  // A product of a node with itself is never negative, which a product of two unknowns could be.
  if (op == Op::mul && operands[0] == operands[1]) return apply(Op::sqr, {operands[0]}, 1);
  DagNode node;
  node.op = op;
  node.operands = operands;
  return intern(node);
}

std::vector<NodeId> needed_nodes(const Dag& dag, const std::vector<NodeId>& roots) {
  std::vector<NodeId> needed = roots, open = roots;
  std::unordered_set<NodeId> seen(roots.begin(), roots.end());
  while (!open.empty()) {
    const DagNode& node = dag[open.back()];
    open.pop_back();
    for (int k = 0; k < operator_entry(node.op).arity; ++k) {
      const NodeId operand = node.operands[static_cast<std::size_t>(k)];
      if (!seen.insert(operand).second) continue;
      needed.push_back(operand);
      open.push_back(operand);
    }
  }
  std::sort(needed.begin(), needed.end());
  needed.erase(std::unique(needed.begin(), needed.end()), needed.end());
  return needed;
}

}  // namespace hcsp
