// SPDX-License-Identifier: Apache-2.0
// A zone { a | c(x, a) } of space at an item of the time line: which blocks of cells lie in it for every x of
// the domains, and which lie outside it for every x. For any relation c written in the language, by its
// interval extension.
#pragma once

#include <array>
#include <optional>

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
        at_corners_(program, kCorners),
        children_(Evaluation::over_children(program, dim)),
        probe_(children_) {}

  /// Takes the inputs at an item.
  void at(const Grid& grid, const Inputs& inputs, std::size_t item, Brush brush) {
    grid_ = &grid;
    inputs_ = &inputs;
    brush_ = brush;
    inputs.load(at_item_, item);
    at_item_.forward_before_point();
    is_loaded_ = false;
    corners_ = 0;
  }

  /// The evaluation at the item, up to the point.
  [[nodiscard]] const Evaluation& evaluation() const { return at_item_; }

  ChildDecisions decide_children(const CellIndex& origin, std::int64_t child_edge, std::uint64_t open) {
    if (!is_loaded_) {
      at_item_.save(prefix_);
      children_.restore(prefix_);
      is_loaded_ = true;
    }
    evaluate(children_, origin, child_edge);
    ChildDecisions decisions;
    for (std::size_t child = 0; child < 64; ++child) {
      const Interval& holds = children_.get(root(), child);
      decisions.all |= static_cast<std::uint64_t>(operators::is_true(holds)) << child;
      decisions.some |= static_cast<std::uint64_t>(!operators::is_false(holds)) << child;
    }
    const bool cells = child_edge == 1;
    if (brush_ == Brush::outer && cells) decisions.all = decisions.some;
    if (brush_ == Brush::inner && !cells)
      decisions.some &= ~hopeless(origin, child_edge, decisions.some & ~decisions.all & open);
    return decisions;
  }

 private:
  static constexpr std::size_t kCorners = 16;
  static constexpr int kTries = 4;

  [[nodiscard]] std::uint32_t root() const { return at_item_.program().root(); }

  // The children along an axis are layers of lanes.
  void evaluate(Evaluation& evaluation, const CellIndex& origin, std::int64_t child_edge) const {
    std::size_t stride = 1;
    for (std::size_t axis = 0; axis < point_.size(); ++axis, stride *= side_) {
      if (point_[axis] == Inputs::kNone) continue;
      double lo = grid_->line(origin[axis]);
      for (std::size_t layer = 0; layer < side_; ++layer) {
        const double hi = grid_->line(origin[axis] + static_cast<std::int64_t>(layer + 1) * child_edge);
        evaluation.set(point_[axis], Interval::raw(lo, hi), layer * stride);
        lo = hi;
      }
    }
    evaluation.forward_from_point(64);
  }

  // A cell is painted where the relation is certain for all inputs: nowhere in a block, if for some one
  // choice of the inputs it holds nowhere in it. Without this every cell that stays undecided would be looked
  // at. A corner of the inputs' box that rules out one child mostly rules out its neighbours: few are tried,
  // for a block that is kept in vain only costs time.
  std::uint64_t hopeless(const CellIndex& origin, std::int64_t child_edge, std::uint64_t undecided) {
    std::uint64_t ruled_out = 0;
    for (int tries = 0; tries < kTries && undecided != 0; ++tries) {
      const auto child = static_cast<std::size_t>(__builtin_ctzll(undecided));
      undecided &= undecided - 1;
      const std::optional<std::size_t> corner = corner_against(origin, child_edge, child);
      if (!corner) continue;
      at_corners_.save(prefix_, *corner);
      probe_.restore(prefix_);
      evaluate(probe_, origin, child_edge);
      ruled_out |= std::uint64_t{1} << child;
      for (std::uint64_t rest = undecided; rest != 0; rest &= rest - 1) {
        const auto other = static_cast<std::size_t>(__builtin_ctzll(rest));
        if (operators::is_false(probe_.get(root(), other))) ruled_out |= std::uint64_t{1} << other;
      }
      undecided &= ~ruled_out;
    }
    return ruled_out;
  }

  // A corner of the inputs' box for which the relation holds nowhere in a child.
  std::optional<std::size_t> corner_against(const CellIndex& origin, std::int64_t child_edge,
                                            std::size_t child) {
    if (corners_ == 0) take_corners();
    for (std::size_t axis = 0, rest = child; axis < point_.size(); ++axis, rest /= side_) {
      if (point_[axis] == Inputs::kNone) continue;
      const std::int64_t lo = origin[axis] + static_cast<std::int64_t>(rest % side_) * child_edge;
      const Interval layer = Interval::raw(grid_->line(lo), grid_->line(lo + child_edge));
      for (std::size_t lane = 0; lane < corners_; ++lane) at_corners_.set(point_[axis], layer, lane);
    }
    at_corners_.forward_from_point(corners_);
    for (std::size_t lane = 0; lane < corners_; ++lane) {
      if (operators::is_false(at_corners_.get(root(), lane))) return lane;
    }
    return std::nullopt;
  }

  // Loads corners of the inputs' box, one a lane; beyond four inputs, the further ones stay in the middle.
  void take_corners() {
    corners_ = 1;
    for (std::uint32_t i = 0; i < at_item_.program().inputs().size(); ++i) {
      const Interval value = at_item_.get(i);
      const bool is_chosen = inputs_->is_contractible(i);
      const bool varies = is_chosen && !value.is_point() && corners_ < kCorners;
      for (std::size_t lane = 0; lane < kCorners; ++lane) {
        const bool high = (lane & corners_) != 0;
        const Interval corner = varies ? bound_of(value, high) : Interval::raw(value.mid(), value.mid());
        at_corners_.set(i, is_chosen ? corner : value, lane);
      }
      if (varies) corners_ *= 2;
    }
    at_corners_.forward_before_point(corners_);
  }

  static Interval bound_of(const Interval& value, bool high) {
    const double bound = high ? value.hi() : value.lo();
    const double point = std::isfinite(bound) ? bound : value.mid();
    return Interval::raw(point, point);
  }

  const std::vector<std::uint32_t>& point_;
  std::size_t side_;  // children along an edge
  const Grid* grid_ = nullptr;
  const Inputs* inputs_ = nullptr;
  Brush brush_ = Brush::inner;
  Evaluation at_item_, at_corners_;
  Evaluation children_, probe_;  // for all inputs, and for one corner of them
  Evaluation::Prefix prefix_;
  bool is_loaded_ = false;   // children_ has the item's inputs
  std::size_t corners_ = 0;  // taken at the item: none until they are needed
};

}  // namespace hcsp
