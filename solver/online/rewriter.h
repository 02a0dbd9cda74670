// SPDX-License-Identifier: Apache-2.0
// Expressions specialised: nodes replaced by others, and what follows from that folded.
#pragma once

#include <vector>

#include "solver/online/facts.h"
#include "solver/online/node_map.h"

namespace hcsp::online {

/// Copies nodes from one graph to another, or within one.
class Rewriter {
 public:
  Rewriter(const Dag& from, Dag& to, std::vector<NodeId>* dropped = nullptr)
      : from_(from), to_(to), dropped_(dropped) {}

  /// From here on `node` becomes `other`, a node of the graph that is written; before its operands are looked
  /// at.
  void replace(NodeId node, NodeId other) { known_.set(node, other); }
  /// Within one graph: only what needs this input changes.
  void restrict_to(Facts& facts, const Input& input) {
    facts_ = &facts;
    input_ = facts.number_of(input);
  }
  /// Truths that others are made of but by `and` and `or`, and that choose, are left to one that drops
  /// nothing.
  void leave_truths_to(Rewriter& careful) { careful_ = &careful; }
  NodeId operator()(NodeId node);

 private:
  NodeId copy_leaf(NodeId node);

  const Dag& from_;
  Dag& to_;
  std::vector<NodeId>* dropped_;
  NodeMap known_;
  Rewriter* careful_ = nullptr;
  Facts* facts_ = nullptr;
  std::size_t input_ = 0;
};

/// op applied to operands, folded: exact constants, neutral elements, decided choices and connectives. 0 x is
/// 0 where x is defined: such an x is added to `dropped`, or it is only done where x is defined anyway.
NodeId fold(Dag& dag, Op op, std::array<NodeId, 3> operands, std::vector<NodeId>* dropped = nullptr);

/// The same constant in another graph: constants that were one number, or not, remain so.
NodeId copy_constant(const DagNode& constant, Dag& to);

/// A constant that is one exact number.
bool is_number(const Dag& dag, NodeId node);
bool is_number(const Dag& dag, NodeId node, double value);

}  // namespace hcsp::online
