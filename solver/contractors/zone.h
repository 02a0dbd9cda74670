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

inline bool is_one_cell(const Region& cells, std::size_t dim) {
  for (std::size_t axis = 0; axis < dim; ++axis) {
    if (cells.hi[axis] - cells.lo[axis] > 1) return false;
  }
  return true;
}

/// What painting asks of a zone. `inner` paints the cells that certainly lie in the zone; `outer` those that
/// may.
enum class Brush : std::uint8_t { inner, outer };

/// The general zone: the relation's program on a block.
class RelationZone {
 public:
  RelationZone(const Program& program, const std::vector<std::uint32_t>& point)
      : point_(point), evaluation_(program), corners_(program, kCorners) {}

  /// Takes the inputs at an item.
  void at(const Grid& grid, const Inputs& inputs, std::size_t item, Brush brush) {
    grid_ = &grid;
    brush_ = brush;
    inputs.load(evaluation_, item);
    evaluation_.forward_before_point();
    inputs_ = &inputs;
    lanes_ = 0;
  }

  /// The evaluation at the item, up to the point.
  [[nodiscard]] const Evaluation& evaluation() const { return evaluation_; }

  Decision decide(const Region& cells) {
    set_point(evaluation_, cells, 1);
    evaluation_.forward_from_point();
    const std::uint32_t root = evaluation_.program().root();
    const Interval holds = evaluation_.get(root);
    if (operators::is_true(holds)) return Decision::all;
    if (operators::is_false(holds)) return Decision::none;
    const bool one = is_one_cell(cells, grid_->dim());
    if (brush_ == Brush::outer) return one ? Decision::all : Decision::split;
    // A cell is painted where the relation is certain for all inputs: nowhere in the block, if for some one
    // choice of the inputs it holds nowhere in it. Without this every cell that stays undecided would be
    // looked at.
    if (one) return Decision::none;
    if (lanes_ == 0) take_corners();
    set_point(corners_, cells, lanes_);
    corners_.forward_from_point(lanes_);
    for (std::size_t lane = 0; lane < lanes_; ++lane) {
      if (operators::is_false(corners_.get(root, lane))) return Decision::none;
    }
    return Decision::split;
  }

 private:
  static constexpr std::size_t kCorners = 16;

  void set_point(Evaluation& evaluation, const Region& cells, std::size_t lanes) const {
    for (std::size_t axis = 0; axis < point_.size(); ++axis) {
      if (point_[axis] == Inputs::kNone) continue;
      const Interval side = closure(*grid_, cells, axis);
      for (std::size_t lane = 0; lane < lanes; ++lane) evaluation.set(point_[axis], side, lane);
    }
  }

  // Loads corners of the inputs' box, one a lane; beyond four inputs, the further ones stay in the middle.
  void take_corners() {
    lanes_ = 1;
    for (const std::uint32_t i : inputs_->contractible()) {
      const Interval value = evaluation_.get(i);
      const bool varies = !value.is_point() && lanes_ < kCorners;
      for (std::size_t lane = 0; lane < kCorners; ++lane) {
        const bool high = varies && (lane & lanes_) != 0;
        corners_.set(i, varies ? bound_of(value, high) : Interval::raw(value.mid(), value.mid()), lane);
      }
      if (varies) lanes_ *= 2;
    }
    corners_.forward_before_point(lanes_);
  }

  static Interval bound_of(const Interval& value, bool high) {
    const double bound = high ? value.hi() : value.lo();
    const double point = std::isfinite(bound) ? bound : value.mid();
    return Interval::raw(point, point);
  }

  const Grid* grid_ = nullptr;
  const std::vector<std::uint32_t>& point_;
  Evaluation evaluation_;
  Evaluation corners_;
  const Inputs* inputs_ = nullptr;
  std::size_t lanes_ = 0;  // corners taken at the item: none until they are needed
  Brush brush_ = Brush::inner;
};

}  // namespace hcsp
