// SPDX-License-Identifier: Apache-2.0
#include "solver/contractors/meets.h"

#include <algorithm>
#include <cmath>

#include "domains/rounding.h"
#include "domains/set_interval.h"
#include "solver/contractors/ring.h"
#include "solver/contractors/support_search.h"

namespace hcsp {

namespace {

template <class Feel>
class MeetsContractor final : public Contractor {
 public:
  MeetsContractor(std::string name, std::string constraint, VariableId set, Inputs inputs, Feel feel)
      : Contractor(std::move(name), std::move(constraint), Cost::search, with(inputs.variables(), set),
                   inputs.variables()),
        set_(set),
        inputs_(std::move(inputs)),
        feel_(std::move(feel)),
        search_(std::max<std::size_t>(inputs_.contractible().size(), 1)),
        witnesses_(inputs_.items() * search_.faces(), kNoCell),
        box_(search_.faces() / 2) {}

  void contract(Access& access) override {
    RoundUpward guard;
    inputs_.open(access);
    const SetInterval& set = access.domain<SetInterval>(set_);
    const bool set_changed = !access.delta<SetInterval>(set_).is_none();
    const ItemSet changed = inputs_.changed(access);
    const ItemSet items = set_changed ? inputs_.in_window() : changed;
    in_time_.clear();
    items.for_each([&](std::size_t item) {
      if (!inputs_.no_reading_at(item)) in_time_.push_back(item);
    });
    // A sweep forward looks at every item, one back at those where what was found later matters.
    std::size_t neighbour = 0;
    const auto look = [&](std::size_t item) {
      if (!contract_at(set, item, neighbour)) {
        access.fail(inputs_.variables().empty() ? set_ : inputs_.blamed(), inputs_.when(item));
      }
      neighbour = item;
    };
    for (const std::size_t item : in_time_) {
      if (access.should_stop()) break;
      const bool moved = inputs_.carry(item, Inputs::Direction::forward) || changed.contains(item);
      // The box is as the last look left it, fully supported: it still is, if its witnesses are still in S+.
      if (moved || !search_.all_stand(set, &witnesses_[item * search_.faces()])) look(item);
    }
    for (auto item = in_time_.rbegin(); item != in_time_.rend() && !access.should_stop(); ++item) {
      if (inputs_.carry(*item, Inputs::Direction::backward)) look(*item);
    }
    inputs_.report(access);
  }

 private:
  static std::vector<VariableId> with(std::vector<VariableId> variables, VariableId v) {
    variables.push_back(v);
    return variables;
  }

  bool contract_at(const SetInterval& set, std::size_t item, std::size_t neighbour) {
    const auto& contractible = inputs_.contractible();
    for (std::size_t i = 0; i < contractible.size(); ++i) box_[i] = inputs_.value(contractible[i], item);
    feel_.at(inputs_, item, box_);
    CellIndex* mine = &witnesses_[item * search_.faces()];
    const CellIndex* theirs = &witnesses_[neighbour * search_.faces()];
    const std::vector<Interval>& hull = search_.run(set, feel_, box_, mine, theirs);
    if (search_.found_none()) return false;
    bool alive = true;
    for (std::size_t i = 0; i < contractible.size(); ++i)
      alive = inputs_.narrow(contractible[i], item, hull[i]) && alive;
    return alive;
  }

  VariableId set_;
  Inputs inputs_;
  Feel feel_;
  SupportSearch search_;
  std::vector<CellIndex> witnesses_;  // by item and face: a cell that supported the face when last looked at
  std::vector<Interval> box_;         // of the contractible inputs; where there is none, any one interval
  std::vector<std::size_t> in_time_;  // the items at hand
};

// The general feeler: HC4-revise of the relation with the bound point in a block.
class RelationFeel {
 public:
  RelationFeel(Program program, const Inputs& inputs, std::size_t dim)
      : program_(std::make_unique<Program>(std::move(program))),
        evaluation_(*program_),
        contractible_(inputs.contractible()),
        point_(inputs.point()) {
    point_.resize(dim, Inputs::kNone);
  }

  void at(const Inputs& inputs, std::size_t item, const std::vector<Interval>&) {
    inputs.load(evaluation_, item);
    evaluation_.forward_before_point();
    evaluation_.save(prefix_);
  }

  // The part of the inputs' box that a point of the block supports; false when there is none.
  bool operator()(const std::array<Interval, 3>& block, Interval* result) {
    evaluation_.restore(prefix_);
    for (std::size_t axis = 0; axis < point_.size(); ++axis) {
      if (point_[axis] != Inputs::kNone) evaluation_.set(point_[axis], block[axis]);
    }
    evaluation_.forward_from_point();
    if (!evaluation_.backward(kTrue)) return false;
    if (contractible_.empty()) result[0] = Interval::entire();
    for (std::size_t i = 0; i < contractible_.size(); ++i) result[i] = evaluation_.get(contractible_[i]);
    return true;
  }

 private:
  std::unique_ptr<const Program> program_;  // at a fixed address, for the evaluation
  Evaluation evaluation_;
  std::vector<std::uint32_t> contractible_, point_;
  Evaluation::Prefix prefix_;  // at the item, up to the point
};

// norm(a - e) == r with e and r inputs: the operations of the general path, in its order, without the
// bytecode.
template <std::size_t kDim>
class RingFeel {
 public:
  RingFeel(const Ring& ring, std::array<std::size_t, 3> center, std::size_t radius)
      : ring_(ring), center_place_(center), radius_place_(radius) {}

  void at(const Inputs&, std::size_t, const std::vector<Interval>& box) {
    for (std::size_t k = 0; k < kDim; ++k) center_[k] = box[center_place_[k]].bounds();
    const Interval& radius = box[radius_place_];
    radius_ = radius.bounds();
    // Squared distances outside these bounds have roots outside the radius, by more than the rounding of a
    // root.
    constexpr double kMargin = 0x1p-48;
    const double nearest = std::max(radius.lo(), 0.0);
    near_ = up::mul_down(up::mul_down(nearest, nearest), 1.0 - 2 * kMargin);
    far_ = radius.hi() * radius.hi() * (1.0 + kMargin);
  }

  bool operator()(const std::array<Interval, 3>& block, Interval* result) const {
    std::array<Bounds, kDim> difference, square, sum;
    for (std::size_t k = 0; k < kDim; ++k) {
      const Bounds side = block[ring_.axis[k]].bounds();
      difference[k] = ring_.point_first[k] ? side + swapped(center_[k]) : center_[k] + swapped(side);
      square[k] = up::sqr(Interval::of_bounds(difference[k])).bounds();
      sum[k] = k == 0 ? square[0] : sum[k - 1] + square[k];
    }
    Bounds total = sum[kDim - 1];
    if (total[1] < near_ || -total[0] > far_) return false;
    const Bounds radius = least(up::root(total), radius_);
    if (is_void(radius)) return false;
    total = least(up::square_of_positive(radius), total);
    bool none = is_void(total);
    for (std::size_t k = kDim; k-- > 0;) {
      if (k > 0) {
        const Bounds rest = least(sum[k - 1], total + swapped(square[k]));
        square[k] = least(square[k], total + swapped(rest));
        none = none || is_void(rest) || is_void(square[k]);
        total = rest;
      } else {
        square[0] = total;
      }
      none = none || !contract_center(block[ring_.axis[k]].bounds(), k, square[k], difference[k], result);
    }
    result[radius_place_] = Interval::of_bounds(radius);
    return !none;
  }

 private:
  static bool is_void(const Bounds& bounds) { return -bounds[0] > bounds[1]; }

  // Sqr and Sub backward, from the square of the difference to the center.
  bool contract_center(const Bounds& side, std::size_t k, const Bounds& square, const Bounds& known,
                       Interval* result) const {
    const Bounds root = up::root(square), nothing = Interval::empty().bounds();
    Bounds above = least(root, known), below = least(swapped(root), known);
    if (is_void(above)) above = nothing;
    if (is_void(below)) below = nothing;
    const Bounds difference = greatest(above, below);
    Bounds center = center_[k], felt = side;
    if (ring_.point_first[k]) {
      felt = least(side, difference + center);
      center = least(center, felt + swapped(difference));
    } else {
      center = least(center, difference + side);
      felt = least(side, center + swapped(difference));
    }
    result[center_place_[k]] = Interval::of_bounds(center);
    return !is_void(difference) && !is_void(felt) && !is_void(center);
  }

  Ring ring_;
  std::array<std::size_t, 3> center_place_;  // by term: its center's place in the box
  std::size_t radius_place_;
  std::array<Bounds, kDim> center_{};
  Bounds radius_{};
  double near_ = 0.0, far_ = kInfinity;
};

// A ring can be felt by the fast path when its center and radius are inputs themselves, all different.
struct FeelableRing {
  Ring ring;
  std::array<std::size_t, 3> center;
  std::size_t radius;
};

std::optional<FeelableRing> feelable_ring(const Dag& dag, NodeId relation, const Program& program,
                                          const Inputs& inputs, std::size_t set_dim) {
  const std::optional<Ring> ring = match_ring(dag, relation);
  if (!ring || ring->relation != Op::equal || ring->dim != set_dim) return std::nullopt;
  const auto place_of = [&](NodeId node) -> std::optional<std::size_t> {
    if (dag[node].op != Op::input) return std::nullopt;
    const auto& contractible = inputs.contractible();
    const auto found = std::find(contractible.begin(), contractible.end(), program.register_of(node));
    if (found == contractible.end()) return std::nullopt;
    return static_cast<std::size_t>(found - contractible.begin());
  };
  std::array<std::size_t, 3> center{};
  std::vector<std::size_t> used;
  for (std::size_t k = 0; k < ring->dim; ++k) {
    const auto place = place_of(ring->center[k]);
    if (!place) return std::nullopt;
    center[k] = *place;
    used.push_back(*place);
  }
  const auto radius = place_of(ring->radius);
  if (!radius) return std::nullopt;
  used.push_back(*radius);
  std::sort(used.begin(), used.end());
  if (std::adjacent_find(used.begin(), used.end()) != used.end() ||
      used.size() != inputs.contractible().size()) {
    return std::nullopt;
  }
  return FeelableRing{*ring, center, *radius};
}

}  // namespace

std::unique_ptr<Contractor> make_meets_contractor(std::string name, std::string constraint, VariableId set,
                                                  std::size_t set_dim, const Dag& dag, NodeId relation,
                                                  const Inputs::Context& context, bool fast_paths) {
  Program program(dag, {relation});
  Inputs inputs(program, context);
  const auto make = [&](auto feel) -> std::unique_ptr<Contractor> {
    return std::make_unique<MeetsContractor<decltype(feel)>>(std::move(name), std::move(constraint), set,
                                                             std::move(inputs), std::move(feel));
  };
  if (fast_paths) {
    const auto fast = feelable_ring(dag, relation, program, inputs, set_dim);
    if (fast && set_dim == 2) return make(RingFeel<2>(fast->ring, fast->center, fast->radius));
    if (fast && set_dim == 3) return make(RingFeel<3>(fast->ring, fast->center, fast->radius));
  }
  return make(RelationFeel(std::move(program), inputs, set_dim));
}

}  // namespace hcsp
