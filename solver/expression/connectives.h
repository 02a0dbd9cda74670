// SPDX-License-Identifier: Apache-2.0
// What a connective of a graph connects.
#pragma once

#include <vector>

#include "solver/expression/dag.h"

namespace hcsp {

/// The operands of a chain of one connective, each once, in their order; the node itself where it is none.
std::vector<NodeId> operands_of(const Dag& dag, NodeId node, Op connective);

/// The relations of a sum that counts which of them hold, up to some number of nodes; none where the node is
/// no such sum or has more.
std::vector<NodeId> counted_relations(const Dag& dag, NodeId sum, std::size_t most);

/// Whether a quantifier over a real occurs in a node.
bool has_quantifier(const Dag& dag, NodeId node);

}  // namespace hcsp
