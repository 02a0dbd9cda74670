// SPDX-License-Identifier: Apache-2.0
// A zone { a | c(x, a) } of space at an item of the time line: which blocks of cells lie in it for every x of the
// domains, and which lie outside it for every x. For any relation c written in the language, by its interval extension.
#pragma once

#include <array>

#include "domains/set_descent.h"
#include "solver/contractors/inputs.h"
#include "solver/expression/operators.h"

namespace hcsp {

/// Puts the closure of a block of cells into the bound point's inputs. Contractors decide on closures: what holds on a
/// closure holds on the half-open cells in it.
inline Interval block_side(const Grid& grid, const CellIndex& lo, std::int64_t edge, std::size_t axis) {
  return Interval::raw(grid.line(lo[axis]), grid.line(lo[axis] + edge));
}

/// What painting asks of a zone. `inner` paints the cells that certainly lie in the zone; `outer` those that may.
enum class Brush : std::uint8_t { inner, outer };

/// The general zone: the relation's program on a block. The evaluation holds the item's inputs, evaluated up to the
/// point (Evaluation::forward_before_point).
class RelationZone {
 public:
  RelationZone(const Grid& grid, const std::vector<std::uint32_t>& point, Evaluation& evaluation, Brush brush)
      : grid_(grid), point_(point), evaluation_(evaluation), brush_(brush) {}

  Decision decide(const CellIndex& lo, std::int64_t edge) {
    for (std::size_t axis = 0; axis < point_.size(); ++axis) {
      if (point_[axis] != Inputs::kNone) evaluation_.set(point_[axis], block_side(grid_, lo, edge, axis));
    }
    evaluation_.forward_from_point();
    const Interval holds = evaluation_.get(evaluation_.program().root());
    if (operators::is_true(holds)) return Decision::all;
    if (operators::is_false(holds)) return Decision::none;
    return brush_ == Brush::outer && edge == 1 ? Decision::all : Decision::split;
  }

 private:
  const Grid& grid_;
  const std::vector<std::uint32_t>& point_;
  Evaluation& evaluation_;
  Brush brush_;
};

}  // namespace hcsp
