// SPDX-License-Identifier: Apache-2.0
// How a contractor decides a set interval: it hands a Zone, which looks at a box of cells and says that all
// of them, none of them, or neither are to be settled; undecided blocks are split down to the cell. The boxes
// are those around the cells that are still open, so what is settled already costs nothing. A Zone has
//   Decision decide(const Region& cells);
// or, to decide the 64 children of a node at once, each a cube of child_edge cells,
//   ChildDecisions decide_children(const CellIndex& origin, std::int64_t child_edge, std::uint64_t open);
// where only the open children matter.
#pragma once

#include "domains/set_interval.h"

namespace hcsp {

enum class Decision : std::uint8_t { none, all, split };

/// Which children of a node are to be settled whole, and which may hold cells to settle (bit x + side y +
/// side^2 z).
struct ChildDecisions {
  std::uint64_t all = 0;
  std::uint64_t some = 0;
};

template <class Zone>
Region SetInterval::include(const Region& bounds, Zone& zone) {
  return decide<true>(bounds, zone);
}

template <class Zone>
Region SetInterval::exclude(const Region& bounds, Zone& zone) {
  return decide<false>(bounds, zone);
}

template <class Visit>
void SetInterval::for_each_upper_part(const Block& block, Visit visit) const {
  const bool uniform = block.node == kNoNode;
  if (uniform && !block.any_upper) return;
  for (int corner = 0; corner < (1 << dim()); ++corner) {
    const std::uint64_t mask = uniform ? 0 : mask_of_part(block, corner);
    if (uniform || (nodes_[block.node].upper & mask) != 0) visit(part(block, corner, mask));
  }
}

template <bool kInclude, class Zone>
Region SetInterval::decide(const Region& bounds, Zone& zone) {
  Region delta;
  if (empty_ || !bounds.has_cells()) return delta;
  cover(bounds);
  descend_node<kInclude>(root_, root_edge() >> axis_bits(), origin_, bounds, zone, delta);
  return delta;
}

// A node whole: child by child where the zone can, or by halves.
template <bool kInclude, class Zone>
void SetInterval::descend_node(std::uint32_t node, std::int64_t child_edge, const CellIndex& origin,
                               const Region& bounds, Zone& zone, Region& delta) {
  if constexpr (requires { zone.decide_children(origin, child_edge, std::uint64_t{}); }) {
    std::uint64_t open = kInclude ? ~nodes_[node].lower : nodes_[node].upper;
    std::uint64_t whole = open;
    if (!bounds.holds(Region::block(origin, child_edge << axis_bits(), dim()), dim())) {
      whole &= children_within(bounds, origin, child_edge, true);
      open &= children_within(bounds, origin, child_edge, false);
    }
    if (open == 0) return;
    const ChildDecisions decisions = zone.decide_children(origin, child_edge, open);
    const std::uint64_t all = decisions.all & whole;
    if (all != 0) {
      settle<kInclude>(node, all);
      delta.join(bounds_of(all, origin, child_edge));
    }
    if (child_edge == 1) return;
    for (std::uint64_t rest = (decisions.some | decisions.all) & open & ~all; rest != 0 && !empty_;
         rest &= rest - 1) {
      const int bit = __builtin_ctzll(rest);
      const CellIndex lo = child_place(origin, child_edge, bit);
      descend_node<kInclude>(child(node, bit), child_edge >> axis_bits(), lo, bounds, zone, delta);
      refresh(node, bit);
    }
  } else {
    descend<kInclude>(node, child_edge, origin, side(), 0, bounds, zone, delta);
  }
}

template <bool kInclude, class Zone>
void SetInterval::descend(std::uint32_t node, std::int64_t child_edge, const CellIndex& origin,
                          std::int64_t part, int bit, const Region& bounds, Zone& zone, Region& delta) {
  const std::uint64_t mask = part_mask(part, bit);
  const std::uint64_t open = mask & (kInclude ? ~nodes_[node].lower : nodes_[node].upper);
  if (open == 0 || empty_) return;
  const Region around = bounds_of(open, origin, child_edge);
  if (!bounds.meets(around, dim())) return;
  const Region cells = around.common(bounds, dim());
  const Decision decision = zone.decide(cells);
  if (decision == Decision::none) return;
  if (decision == Decision::all && bounds.holds(around, dim())) {
    settle<kInclude>(node, open);
    delta.join(cells);
    return;
  }
  if (part > 1) {
    for (int corner = 0; corner < (1 << dim()); ++corner) {
      descend<kInclude>(node, child_edge, origin, part / 2, bit + part_bit(part / 2, corner), bounds, zone,
                        delta);
    }
  } else if (child_edge > 1) {
    const CellIndex lo = child_place(origin, child_edge, bit);
    descend_node<kInclude>(child(node, bit), child_edge >> axis_bits(), lo, bounds, zone, delta);
    refresh(node, bit);
  }
}

template <bool kInclude>
void SetInterval::settle(std::uint32_t node, std::uint64_t mask) {
  // A cell that is outside cannot be included, nor one that is inside excluded: the domain is then empty.
  if (has_cell(node, mask, kInclude ? CellState::outside : CellState::inside)) empty_ = true;
  for (std::uint64_t rest = nodes_[node].mixed & mask; rest != 0; rest &= rest - 1) {
    free_node(children_[nodes_[node].children][static_cast<std::size_t>(__builtin_ctzll(rest))]);
  }
  Node& settled = nodes_[node];
  settled.mixed &= ~mask;
  settled.lower = kInclude ? settled.lower | mask : settled.lower & ~mask;
  settled.upper = kInclude ? settled.upper | mask : settled.upper & ~mask;
}

}  // namespace hcsp
