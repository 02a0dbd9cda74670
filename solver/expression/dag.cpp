// SPDX-License-Identifier: Apache-2.0
#include "solver/expression/dag.h"

#include <algorithm>
#include <bit>
#include <unordered_set>

#include "domains/check.h"
#include "solver/expression/operators.h"

namespace hcsp {

namespace {

bool is_same(const DagNode& a, const DagNode& b) {
  return a.op == b.op && a.operands == b.operands && a.value.lo() == b.value.lo() &&
         a.value.hi() == b.value.hi() && a.input == b.input;
}

std::size_t hash_of(const DagNode& node) {
  std::uint64_t hash = static_cast<std::uint64_t>(node.op);
  const auto mix = [&](std::uint64_t x) {
    hash = (hash ^ x) * 0x9e3779b97f4a7c15U;
    hash ^= hash >> 32;
  };
  for (const NodeId operand : node.operands) mix(operand);
  if (node.op == Op::constant || node.op == Op::input) {
    for (const double bound : {node.value.lo(), node.value.hi()})
      mix(bound == 0.0 ? 0 : std::bit_cast<std::uint64_t>(bound));  // 0 and -0 are one number
    mix(static_cast<std::uint64_t>(node.input.kind));
    mix(node.input.variable);
    mix(node.input.component);
    mix(node.input.gate);
  }
  return hash;
}

bool may_be_undefined(Op op) {
  switch (op) {
    case Op::div:
    case Op::sqrt:
    case Op::log:
    case Op::tan:
    case Op::asin:
    case Op::acos:
    case Op::atan2:
    case Op::pown:
    case Op::pow:
    case Op::root:
      return true;
    default:
      return false;
  }
}

}  // namespace

// Where a node is, or would be.
NodeId& Dag::slot_of(const DagNode& node) {
  const std::size_t mask = slots_.size() - 1;
  std::size_t at = hash_of(node) & mask;
  while (slots_[at] != 0 && !is_same(nodes_[slots_[at] - 1], node)) at = (at + 1) & mask;
  return slots_[at];
}

// At most half of the table is taken.
void Dag::make_room() {
  constexpr std::size_t kFirst = 256;
  if (2 * (nodes_.size() + 1) <= slots_.size()) return;
  slots_.assign(std::max(kFirst, 2 * slots_.size()), 0);
  for (std::size_t id = 0; id < nodes_.size(); ++id) slot_of(nodes_[id]) = static_cast<NodeId>(id + 1);
}

NodeId Dag::intern(const DagNode& node) {
  make_room();
  NodeId& slot = slot_of(node);
  if (slot == 0) {
    nodes_.push_back(node);
    slot = static_cast<NodeId>(nodes_.size());
  }
  return slot - 1;
}

NodeId Dag::constant(const Interval& value, std::uint64_t origin) {
  DagNode node;
  node.value = value;
  node.is_total = !value.is_empty();
  // A number that is known exactly is what it is, wherever it comes from.
  if (!value.is_point())
    node.input = {{}, 0, static_cast<std::uint32_t>(origin), static_cast<std::uint32_t>(origin >> 32)};
  return intern(node);
}

NodeId Dag::own_constant(const Interval& value) {
  DagNode node;
  node.value = value;
  node.is_total = !value.is_empty();
  node.input = {{}, 1, ++own_constants_, 0};  // only to tell it from others
  return intern(node);
}

NodeId Dag::input(const Input& input) {
  DagNode node;
  node.op = Op::input;
  node.is_total = true;
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
  node.is_total = !may_be_undefined(op);
  for (int k = 0; k < count; ++k)
    node.is_total = node.is_total && nodes_[operands[static_cast<std::size_t>(k)]].is_total;
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
