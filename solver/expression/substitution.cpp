// SPDX-License-Identifier: Apache-2.0
#include "solver/expression/substitution.h"

#include "solver/expression/operators.h"

namespace hcsp {

NodeId Substitution::of(NodeId root) {
  for (const NodeId id : needed_nodes(dag_, {root})) {
    if (known_.contains(id)) continue;
    const DagNode node = dag_[id];
    const int arity = operator_entry(node.op).arity;
    std::array<NodeId, 3> operands = node.operands;
    for (int k = 0; k < arity; ++k)
      operands[static_cast<std::size_t>(k)] = known_.at(operands[static_cast<std::size_t>(k)]);
    known_.emplace(id, operands == node.operands ? id : dag_.apply(node.op, operands, arity));
  }
  return known_.at(root);
}

}  // namespace hcsp
