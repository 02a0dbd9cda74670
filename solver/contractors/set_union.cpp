// SPDX-License-Identifier: Apache-2.0
#include "solver/contractors/set_union.h"

#include <algorithm>
#include <cmath>

#include "domains/rounding.h"
#include "domains/set_interval.h"
#include "solver/contractors/ring.h"
#include "solver/contractors/zone.h"

namespace hcsp {

namespace {

// Where a zone is unbounded, painting stays within this many cells of the origin, and of where the set began:
// a fixed region, so that the fixed point does not depend on how far the tree has grown.
constexpr std::int64_t kHome = 1024;

Region home_of(const SetInterval& initial) {
  Region home = initial.reach();
  for (std::size_t axis = 0; axis < initial.dim(); ++axis) {
    home.lo[axis] = std::min(home.lo[axis], -kHome);
    home.hi[axis] = std::max(home.hi[axis], kHome);
  }
  return home;
}

struct Everywhere {
  static Decision decide(const Region&) { return Decision::all; }
};

std::vector<VariableId> with(std::vector<VariableId> variables, VariableId v) {
  if (std::find(variables.begin(), variables.end(), v) == variables.end()) variables.push_back(v);
  return variables;
}

Planes keep_painted(Planes target, Planes painted) { return {target.lower, target.upper & painted.lower}; }
Planes rest_outside(Planes painted, Planes home) {
  return {painted.lower, painted.upper & (painted.lower | ~home.lower)};
}
Planes keep_upper(Planes target, Planes painted) { return {target.lower, target.upper & painted.upper}; }

class UnionContractor final : public Contractor {
 public:
  UnionContractor(std::string name, std::string constraint, VariableId set, const SetInterval& initial,
                  Program program, Inputs inputs, std::optional<Ring> ring)
      : Contractor(std::move(name), std::move(constraint), Cost::search, with(inputs.variables(), set),
                   with(inputs.variables(), set)),
        set_(set),
        program_(std::move(program)),
        inputs_(std::move(inputs)),
        ring_(ring),
        point_(inputs_.point()),
        zone_(program_, point_, initial.dim()),
        hull_(program_),
        home_(home_of(initial)) {
    point_.resize(initial.dim(), Inputs::kNone);
  }

  void contract(Access& access) override {
    RoundUpward guard;
    inputs_.open(access);
    SetInterval& set = access.edit<SetInterval>(set_);
    const ItemSet changed = inputs_.changed(access);
    Region delta = paint_inner(access, set, changed);
    if (!set.is_empty() && !changed.is_none()) delta.join(keep_outer(access, set));
    if (!set.is_empty() && set.has_outside()) {
      const bool set_changed = !access.delta<SetInterval>(set_).is_none() || !delta.is_none();
      leave_out(access, set, set_changed ? inputs_.in_window() : changed);
    }
    access.report<SetInterval>(set_, delta);
    inputs_.report(access);
    if (set.is_empty() || !set.has_outside())
      access.settled();  // the inputs did not move, and they alone decide
  }

 private:
  // The disc of the item that zone_ is at, when the zone is one.
  std::optional<DiscZone> disc(const Grid& grid, Brush brush) const {
    if (!ring_ || ring_->dim != grid.dim()) return std::nullopt;
    const Evaluation& evaluation = zone_.evaluation();
    const std::uint32_t radius = program_.register_of(ring_->radius);
    bool defined = evaluation.defined(radius);
    std::array<Interval, 3> center;
    for (std::size_t k = 0; k < ring_->dim; ++k) {
      const std::uint32_t place = program_.register_of(ring_->center[k]);
      center[k] = evaluation.get(place);
      defined = defined && evaluation.defined(place) && !center[k].is_empty();
    }
    if (!defined) return std::nullopt;
    return DiscZone(grid, *ring_, center, evaluation.get(radius), brush);
  }

  Region paint_inner(Access& access, SetInterval& set, const ItemSet& items) {
    Region delta;
    for (const std::size_t item : coarse_to_fine(items)) {
      if (set.is_empty() || access.should_stop()) break;
      zone_.at(set.grid(), inputs_, item, Brush::inner);
      if (auto zone = disc(set.grid(), Brush::inner)) {
        delta.join(set.include(clipped(zone->inner_bounds()), *zone));
      } else if (const auto bounds = inner_bounds(set.grid(), item)) {
        delta.join(set.include(clipped(*bounds), zone_));
      }
    }
    return delta;
  }

  // The items that have readings, every 128th first, then those half-way between, and so on: zones of
  // neighbours overlap, so that most of a later one is painted already and costs nothing.
  const std::vector<std::size_t>& coarse_to_fine(const ItemSet& items) {
    in_time_.clear();
    order_.clear();
    items.for_each([&](std::size_t item) {
      if (!inputs_.no_reading_at(item)) in_time_.push_back(item);
    });
    constexpr std::size_t kCoarsest = 128;
    for (std::size_t i = 0; i < in_time_.size(); i += kCoarsest) order_.push_back(in_time_[i]);
    for (std::size_t step = kCoarsest; step > 1; step /= 2) {
      for (std::size_t i = step / 2; i < in_time_.size(); i += step) order_.push_back(in_time_[i]);
    }
    return order_;
  }

  // The certain zone lies within the zone of any one choice of inputs, which is easier to bound.
  std::optional<Region> inner_bounds(const Grid& grid, std::size_t item) {
    inputs_.load(hull_, item);
    for (std::uint32_t i = 0; i < program_.inputs().size(); ++i) {
      if (program_.inputs()[i].kind != Input::Kind::point) hull_.set(i, one_of(hull_.get(i)));
    }
    return zone_bounds(grid);
  }

  // S+ := S+ without what no item's zone may hold. Says nothing unless every item has a reading; where a zone
  // is unbounded, nothing about what is far from home.
  Region keep_outer(Access& access, SetInterval& set) {
    std::vector<std::pair<std::size_t, Region>> zones;  // by item
    bool bounded = true, readable = true;
    inputs_.in_window().for_each([&](std::size_t item) {
      readable = readable && !inputs_.no_reading_at(item) && !access.should_stop();
      if (!readable) return;
      inputs_.load(hull_, item);
      const auto bounds = zone_bounds(set.grid());
      if (bounds) zones.emplace_back(item, *bounds);
      bounded = bounded && (!bounds || is_addressable(*bounds));
    });
    if (!readable) return {};
    SetInterval painted(set.dim(), set.precision());
    for (const auto& [item, bounds] : zones) {
      if (access.should_stop()) return {};
      zone_.at(set.grid(), inputs_, item, Brush::outer);
      if (auto zone = disc(set.grid(), Brush::outer)) {
        painted.include(clipped(bounds), *zone);
      } else {
        painted.include(clipped(bounds), zone_);
      }
    }
    if (bounded) return combine(set, painted, keep_painted, SetInterval::everywhere());
    SetInterval home(set.dim(), set.precision());
    Everywhere all;
    home.include(home_, all);
    combine(painted, home, rest_outside, SetInterval::everywhere());
    return combine(set, painted, keep_upper, SetInterval::everywhere());
  }

  static Interval one_of(const Interval& x) {
    if (x.is_empty()) return x;
    const double point = std::isfinite(x.lo()) ? x.lo() : (std::isfinite(x.hi()) ? x.hi() : 0.0);
    return Interval::raw(point, point);
  }

  // The cells that a box around the zone touches, for the inputs in hull_; none when the zone is empty.
  std::optional<Region> zone_bounds(const Grid& grid) {
    for (const std::uint32_t p : point_) {
      if (p != Inputs::kNone) hull_.set(p, Interval::entire());
    }
    hull_.forward();
    if (!hull_.backward(kTrue)) return std::nullopt;
    Region region;
    for (std::size_t axis = 0; axis < grid.dim(); ++axis) {
      const Interval side = point_[axis] == Inputs::kNone ? Interval::entire() : hull_.get(point_[axis]);
      region.lo[axis] = side.lo() == -kInfinity ? -Grid::kReach : grid.cell_of(side.lo());
      region.hi[axis] = side.hi() == kInfinity ? Grid::kReach : grid.cell_of(side.hi()) + 1;
    }
    return region;
  }

  [[nodiscard]] bool is_addressable(const Region& bounds) const {
    for (std::size_t axis = 0; axis < point_.size(); ++axis) {
      if (bounds.lo[axis] <= -Grid::kReach || bounds.hi[axis] >= Grid::kReach) return false;
    }
    return true;
  }

  [[nodiscard]] Region clipped(Region bounds) const {
    for (std::size_t axis = 0; axis < point_.size(); ++axis) {
      if (bounds.lo[axis] <= -Grid::kReach) bounds.lo[axis] = std::min(home_.lo[axis], bounds.hi[axis] - 1);
      if (bounds.hi[axis] >= Grid::kReach) bounds.hi[axis] = std::max(home_.hi[axis], bounds.lo[axis] + 1);
    }
    return bounds;
  }

  void leave_out(Access& access, SetInterval& set, const ItemSet& items) {
    bool alive = true;
    items.for_each([&](std::size_t item) {
      if (!alive || inputs_.no_reading_at(item) || access.should_stop()) return;
      // Only points in the zone's bounds matter. Beyond the tree the set is outside, too, where its
      // background is.
      inputs_.load(hull_, item);
      auto bounds = zone_bounds(set.grid());
      if (!bounds) return;
      *bounds = clipped(*bounds);
      set.cover(*bounds);
      if (leave_out_of(set, set.root(), *bounds, item)) return;
      alive = false;
      access.fail(inputs_.variables().empty() ? set_ : inputs_.blamed(), inputs_.when(item));
    });
  }

  // Contracts the inputs at an item so that no point of the block's cells outside S+ lies in the zone. The
  // points tried are corners of cells: a choice, but any point that is outside is a sound one. False when
  // nothing is left.
  bool leave_out_of(const SetInterval& set, const SetInterval::Block& block, const Region& bounds,
                    std::size_t item) {
    const Region cells = Region::block(block.lo, block.edge, set.dim());
    if (block.all_upper || !bounds.meets(cells, set.dim()) || !may_hold(set, block, item)) return true;
    if (!block.any_upper && bounds.holds(cells, set.dim())) {
      for (int corner = 0; corner < (1 << set.dim()); ++corner) {
        if (!leave_out_point(set, block, corner, item)) return false;
      }
      if (!may_hold(set, block, item)) return true;
    }
    if (block.edge == 1) return true;
    for (int corner = 0; corner < (1 << set.dim()); ++corner) {
      if (!leave_out_of(set, set.part(block, corner), bounds, item)) return false;
    }
    return true;
  }

  // Whether the zone may meet a block.
  bool may_hold(const SetInterval& set, const SetInterval::Block& block, std::size_t item) {
    inputs_.load(hull_, item);
    for (std::size_t axis = 0; axis < point_.size(); ++axis) {
      if (point_[axis] != Inputs::kNone)
        hull_.set(point_[axis], closure(set.grid(), Region::block(block.lo, block.edge, set.dim()), axis));
    }
    hull_.forward();
    return !operators::is_false(hull_.get(program_.root()));
  }

  bool leave_out_point(const SetInterval& set, const SetInterval::Block& block, int corner,
                       std::size_t item) {
    inputs_.load(hull_, item);
    for (std::size_t axis = 0; axis < point_.size(); ++axis) {
      if (point_[axis] == Inputs::kNone) continue;
      const Interval side = closure(set.grid(), Region::block(block.lo, block.edge, set.dim()), axis);
      // Blocks are half-open: the last double before the far face is the corner that belongs to it.
      const double at = ((corner >> axis) & 1) != 0 ? up::next_down(side.hi()) : side.lo();
      hull_.set(point_[axis], Interval::raw(at, at));
    }
    hull_.forward();
    return hull_.backward(kFalse) && inputs_.store(hull_, item);
  }

  VariableId set_;
  Program program_;
  Inputs inputs_;
  std::optional<Ring> ring_;
  std::vector<std::uint32_t> point_;  // by axis of the set
  RelationZone zone_;                 // at the item that is being painted
  Evaluation hull_;                   // for all else
  Region home_;
  std::vector<std::size_t> in_time_, order_;  // items, while painting
};

}  // namespace

std::unique_ptr<Contractor> make_union_contractor(std::string name, std::string constraint, VariableId set,
                                                  const SetInterval& initial, const Dag& dag, NodeId relation,
                                                  const Inputs::Context& context, bool fast_paths) {
  Program program(dag, {relation});
  Inputs inputs(program, context);
  std::optional<Ring> ring = fast_paths ? match_ring(dag, relation) : std::nullopt;
  if (ring && ring->relation == Op::equal) ring.reset();
  return std::make_unique<UnionContractor>(std::move(name), std::move(constraint), set, initial,
                                           std::move(program), std::move(inputs), ring);
}

}  // namespace hcsp
