// SPDX-License-Identifier: Apache-2.0
#include "solver/expression/connectives.h"

#include <algorithm>
#include <unordered_set>

#include "solver/expression/operators.h"

namespace hcsp {

std::vector<NodeId> operands_of(const Dag& dag, NodeId node, Op connective) {
  std::vector<NodeId> open{node}, parts;
  std::unordered_set<NodeId> seen;
  while (!open.empty()) {
    const NodeId id = open.back();
    open.pop_back();
    if (!seen.insert(id).second) continue;
    if (dag[id].op == connective) {
      open.insert(open.end(), {dag[id].operands[1], dag[id].operands[0]});
    } else {
      parts.push_back(id);
    }
  }
  return parts;
}

std::vector<NodeId> counted_relations(const Dag& dag, NodeId sum, std::size_t most) {
  std::vector<NodeId> open{sum}, relations;
  while (!open.empty() && relations.size() < most) {
    const DagNode& node = dag[open.back()];
    const NodeId id = open.back();
    open.pop_back();
    if (node.op == Op::add) {
      open.insert(open.end(), {node.operands[0], node.operands[1]});
    } else if (is_boolean(node.op)) {
      relations.push_back(id);
    } else {
      return {};
    }
  }
  return open.empty() ? relations : std::vector<NodeId>{};
}

bool has_quantifier(const Dag& dag, NodeId node) {
  const std::vector<NodeId> needed = needed_nodes(dag, {node});
  return std::any_of(needed.begin(), needed.end(), [&](NodeId id) { return is_quantifier(dag[id].op); });
}

}  // namespace hcsp
