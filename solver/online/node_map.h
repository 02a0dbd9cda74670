// SPDX-License-Identifier: Apache-2.0
// A number by node of a graph, for some of its nodes: an open hash table in one piece of room.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "solver/expression/dag.h"

namespace hcsp::online {

class NodeMap {
 public:
  /// What a node has; null where it has nothing. Valid until the next set().
  [[nodiscard]] const std::uint32_t* find(NodeId node) const {
    if (slots_.empty()) return nullptr;
    const Slot& slot = slots_[place_of(node)];
    return slot.node == node ? &slot.value : nullptr;
  }
  void set(NodeId node, std::uint32_t value) {
    if (2 * (used_ + 1) > slots_.size()) grow();
    Slot& slot = slots_[place_of(node)];
    if (slot.node != node) ++used_;
    slot = {node, value};
  }

 private:
  static constexpr NodeId kNone = ~NodeId{0};
  struct Slot {
    NodeId node = kNone;
    std::uint32_t value = 0;
  };

  [[nodiscard]] std::size_t place_of(NodeId node) const {
    constexpr std::uint32_t kSpread = 0x9e3779b9U;
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = (node * kSpread) >> 4 & mask;
    while (slots_[at].node != kNone && slots_[at].node != node) at = (at + 1) & mask;
    return at;
  }
  void grow() {
    constexpr std::size_t kFirst = 64;
    std::vector<Slot> before(std::max(kFirst, 2 * slots_.size()));
    std::swap(before, slots_);
    for (const Slot& slot : before) {
      if (slot.node != kNone) slots_[place_of(slot.node)] = slot;
    }
  }

  std::vector<Slot> slots_;
  std::size_t used_ = 0;
};

}  // namespace hcsp::online
