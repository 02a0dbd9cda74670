// SPDX-License-Identifier: Apache-2.0
// The shared directed acyclic graph of a constraint system's expressions. Nodes are hash-consed: the same
// operator on the same operands is the same node. Children precede parents, so an index order is an
// evaluation order.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "domains/interval/interval.h"
#include "solver/engine/ids.h"

namespace hcsp {

using NodeId = std::uint32_t;

/// The operators, in the order of the table in operators.h.
enum class Op : std::uint8_t {
  constant,
  input,
  neg,
  add,
  sub,
  mul,
  div,
  sqr,
  sqrt,
  abs,
  min,
  max,
  sin,
  cos,
  atan2,
  exp,
  log,
  tan,
  asin,
  acos,
  atan,
  sinh,
  cosh,
  tanh,
  floor,
  ceil,
  sign,
  pown,
  pow,
  root,
  less,
  less_equal,
  equal,
  not_equal,
  logical_and,
  logical_or,
  for_every,
  for_some,
  logical_not,
  if_then_else,
};

/// What a leaf stands for: one scalar that the domains of the variables give.
struct Input {
  enum class Kind : std::uint8_t {
    real,   ///< a real variable, or a component of a vector
    tube,   ///< a component of a tube at the item at hand
    gate,   ///< a component of a tube at a fixed gate
    time,   ///< the identity tube t at the item at hand
    point,  ///< a component of the bound point a of { a | ... }
  };
  Kind kind = Kind::real;
  VariableId variable = 0;
  std::uint32_t component = 0;
  std::uint32_t gate = 0;
  friend auto operator<=>(const Input&, const Input&) = default;
};

struct DagNode {
  Op op = Op::constant;
  std::array<NodeId, 3> operands{};
  bool is_total = false;  // whether it has a value whatever values the leaves below it have
  Interval value;         // of a constant
  Input input;            // of an input
};

class Dag {
 public:
  /// An unknown that is the same wherever the constant stands: [value] is a domain, not a set of values to
  /// try.
  /// Two numbers may have one enclosure: constants of different origins, numbers that their writer gives
  /// them, are different unknowns.
  NodeId constant(const Interval& value, std::uint64_t origin = 0);
  /// Another unknown than every other constant, though the bounds be the same.
  NodeId own_constant(const Interval& value);
  NodeId input(const Input& input);
  /// Throws std::invalid_argument when the number of operands is not the operator's.
  NodeId apply(Op op, std::array<NodeId, 3> operands, int count);

  [[nodiscard]] const DagNode& operator[](NodeId id) const { return nodes_[id]; }
  [[nodiscard]] std::size_t size() const { return nodes_.size(); }

 private:
  NodeId intern(const DagNode& node);
  NodeId& slot_of(const DagNode& node);
  void make_room();

  std::vector<DagNode> nodes_;
  std::vector<NodeId> slots_;  // an open hash table of the nodes, each plus 1; 0 where there is none
  std::uint32_t own_constants_ = 0;
};

/// The nodes that the roots need, in the order of their indices, which is an evaluation order. Costs what
/// there are of them, however large the graph.
std::vector<NodeId> needed_nodes(const Dag& dag, const std::vector<NodeId>& roots);

}  // namespace hcsp
