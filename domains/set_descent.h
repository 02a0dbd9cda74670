// SPDX-License-Identifier: Apache-2.0
// How a contractor decides a set interval: it hands a Zone, which looks at a cubic block of cells and says that all of
// it, none of it, or neither is to be settled; undecided blocks are split down to the cell. Blocks that are settled
// already are not asked for. A Zone has
//   Decision decide(const CellIndex& lo, std::int64_t edge);
// and may have, to decide the 64 cells of a tile at once (bit x + side y + side^2 z),
//   std::uint64_t decide_tile(const CellIndex& lo);
#pragma once

#include "domains/set_interval.h"

namespace hcsp {

enum class Decision : std::uint8_t { none, all, split };

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
    if (uniform || (nodes_[block.node].upper & mask_of_part(block, corner)) != 0) visit(part(block, corner));
  }
}

template <bool kInclude, class Zone>
Region SetInterval::decide(const Region& bounds, Zone& zone) {
  Region delta;
  if (empty_ || !bounds.has_cells()) return delta;
  cover(bounds);
  descend<kInclude>(root_, root_edge() / side(), root_origin(), side(), 0, bounds, zone, delta);
  return delta;
}

template <bool kInclude, class Zone>
void SetInterval::descend(std::uint32_t node, std::int64_t child_edge, const CellIndex& origin, std::int64_t part,
                          int bit, const Region& bounds, Zone& zone, Region& delta) {
  const std::uint64_t mask = part_mask(part, bit);
  const bool settled = kInclude ? (nodes_[node].lower & mask) == mask : (nodes_[node].upper & mask) == 0;
  if (settled || empty_) return;
  const CellIndex lo = child_place(origin, child_edge, bit);
  const std::int64_t edge = part * child_edge;
  if (!bounds.meets(lo, edge, dim())) return;
  if constexpr (requires { zone.decide_tile(lo); }) {
    if (child_edge == 1 && part == side()) {
      const std::uint64_t cells = zone.decide_tile(lo) & (kInclude ? ~nodes_[node].lower : nodes_[node].upper);
      if (cells != 0) {
        settle<kInclude>(node, cells);
        delta.join(Region::block(lo, edge, dim()));
      }
      return;
    }
  }
  const Decision decision = zone.decide(lo, edge);
  if (decision == Decision::none) return;
  if (decision == Decision::all) {
    settle<kInclude>(node, mask);
    delta.join(Region::block(lo, edge, dim()));
  } else if (part > 1) {
    descend_parts<kInclude>(node, child_edge, origin, part, bit, bounds, zone, delta);
  } else if (child_edge > 1) {
    descend_parts<kInclude>(child(node, bit), child_edge / side(), lo, side(), 0, bounds, zone, delta);
    refresh(node, bit);
  }
}

template <bool kInclude, class Zone>
void SetInterval::descend_parts(std::uint32_t node, std::int64_t child_edge, const CellIndex& origin, std::int64_t part,
                                int bit, const Region& bounds, Zone& zone, Region& delta) {
  // The tile decision replaces the halves of a tile, so a tile that is reached through its parent goes in whole.
  if constexpr (requires { zone.decide_tile(origin); }) {
    if (child_edge == 1 && part == side()) return descend<kInclude>(node, 1, origin, part, bit, bounds, zone, delta);
  }
  for (int corner = 0; corner < (1 << dim()); ++corner) {
    descend<kInclude>(node, child_edge, origin, part / 2, bit + part_bit(part / 2, corner), bounds, zone, delta);
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
