// SPDX-License-Identifier: Apache-2.0
// Expressions in which other expressions stand in the place of some.
#pragma once

#include <map>

#include "solver/expression/dag.h"

namespace hcsp {

class Substitution {
 public:
  /// `places`: by node, the node that stands there instead.
  Substitution(Dag& dag, std::map<NodeId, NodeId> places) : dag_(dag), known_(std::move(places)) {}

  /// The expression with what stands instead; the same node where nothing of it is replaced.
  NodeId of(NodeId root);

 private:
  Dag& dag_;
  std::map<NodeId, NodeId> known_;
};

}  // namespace hcsp
