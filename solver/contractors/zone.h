// SPDX-License-Identifier: Apache-2.0
// A zone { a | c(x, a) } of space at an item of the time line: which blocks of cells lie in it for every x of
// the domains, and which lie outside it for every x. For any relation c written in the language, by its
// interval extension.
#pragma once

#include <array>

#include "domains/set_descent.h"
#include "solver/contractors/inputs.h"
#include "solver/expression/operators.h"

namespace hcsp {

/// The closure of a box of cells along an axis. Contractors decide on closures: what holds on a closure holds
/// on the half-open cells in it.
inline Interval closure(const Grid& grid, const Region& cells, std::size_t axis) {
  return Interval::raw(grid.line(cells.lo[axis]), grid.line(cells.hi[axis]));
}

/// What painting asks of a zone. `inner` paints the cells that certainly lie in the zone; `outer` those that
/// may.
enum class Brush : std::uint8_t { inner, outer };

/// The general zone: the relation's program on the 64 children of a block at once.
class RelationZone {
 public:
  RelationZone(const Program& program, const std::vector<std::uint32_t>& point, std::size_t dim)
      : point_(point),
        side_(std::size_t{1} << (6 / dim)),
        at_item_(program),
        children_(Evaluation::over_children(program, dim)),
        cores_(children_) {}

  /// Takes the inputs at an item.
  void at(const Grid& grid, const Inputs& inputs, std::size_t item, Brush brush) {
    grid_ = &grid;
    brush_ = brush;
    inputs.load(at_item_, item);
    at_item_.forward_before_point();
    is_loaded_ = false;
  }

  /// The evaluation at the item, up to the point.
  [[nodiscard]] const Evaluation& evaluation() const { return at_item_; }

  ChildDecisions decide_children(const CellIndex& origin, std::int64_t child_edge, std::uint64_t open) {
    if (!is_loaded_) load();
    set_children(children_, origin, child_edge, false);
    children_.forward_over_children(open);
    ChildDecisions decisions;
    decisions.all = children_.children_where(open, operators::is_true);
    decisions.some = open & ~children_.children_where(open, operators::is_false);
    const bool cells = child_edge == 1;
    if (brush_ == Brush::outer && cells) decisions.all = decisions.some;
    // Between the cells that are certain and those that are out of the question lie all that some inputs rule
    // out: without a test for whole blocks of these, each cell would be looked at.
    const std::uint64_t undecided = decisions.some & ~decisions.all;
    if (brush_ == Brush::inner && !cells && undecided != 0) {
      set_children(cores_, origin, child_edge, true);
      cores_.core_over_children(undecided);
      decisions.some &=
          ~cores_.children_where(undecided, [](const Interval& core) { return core.lo() < 1.0; });
    }
    return decisions;
  }

 private:
  void load() {
    at_item_.save(prefix_);
    children_.restore(prefix_);
    cores_.restore(prefix_);
    is_loaded_ = true;
  }

  // The children along an axis are layers of lanes. As a core a layer is what its cells have in common: from
  // the last one's lower face to the first one's upper face, improper unless they are the same.
  void set_children(Evaluation& evaluation, const CellIndex& origin, std::int64_t child_edge,
                    bool as_cores) const {
    std::size_t stride = 1;
    for (std::size_t axis = 0; axis < point_.size(); ++axis, stride *= side_) {
      if (point_[axis] == Inputs::kNone) continue;
      for (std::size_t layer = 0; layer < side_; ++layer) {
        const std::int64_t first = origin[axis] + static_cast<std::int64_t>(layer) * child_edge;
        const std::int64_t last = first + child_edge - 1;
        const std::int64_t lo = as_cores ? last : first, hi = as_cores ? first : last;
        evaluation.set(point_[axis], Interval::raw(grid_->line(lo), grid_->line(hi + 1)), layer * stride);
      }
    }
  }

  const std::vector<std::uint32_t>& point_;
  std::size_t side_;  // children along an edge
  const Grid* grid_ = nullptr;
  Brush brush_ = Brush::inner;
  Evaluation at_item_, children_, cores_;
  Evaluation::Prefix prefix_;
  bool is_loaded_ = false;  // children_ and cores_ have the item's inputs
};

}  // namespace hcsp
