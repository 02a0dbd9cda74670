// SPDX-License-Identifier: Apache-2.0
#include "solver/contractors/ring.h"

#include "domains/lanes.h"

namespace hcsp {

namespace {

bool depends_on_point(const Dag& dag, NodeId id) {
  const DagNode& node = dag[id];
  if (node.op == Op::input) return node.input.kind == Input::Kind::point;
  for (int k = 0; k < operator_entry(node.op).arity; ++k) {
    if (depends_on_point(dag, node.operands[static_cast<std::size_t>(k)])) return true;
  }
  return false;
}

// One term sqr(a_k - e_k) of the squared norm.
bool match_term(const Dag& dag, NodeId id, Ring& ring) {
  if (dag[id].op != Op::sqr || ring.dim == 3) return false;
  const DagNode& difference = dag[dag[id].operands[0]];
  if (difference.op != Op::sub) return false;
  for (const bool point_first : {true, false}) {
    const NodeId point = difference.operands[point_first ? 0 : 1],
                 center = difference.operands[point_first ? 1 : 0];
    if (dag[point].op != Op::input || dag[point].input.kind != Input::Kind::point ||
        depends_on_point(dag, center))
      continue;
    const std::size_t axis = dag[point].input.component;
    for (std::size_t k = 0; k < ring.dim; ++k) {
      if (ring.axis[k] == axis) return false;
    }
    ring.axis[ring.dim] = axis;
    ring.point_first[ring.dim] = point_first;
    ring.center[ring.dim] = center;
    ++ring.dim;
    return true;
  }
  return false;
}

// The sum ((t1 + t2) + t3), the shape that norm and dot write.
bool match_sum(const Dag& dag, NodeId id, Ring& ring) {
  if (dag[id].op != Op::add) return match_term(dag, id, ring);
  return match_sum(dag, dag[id].operands[0], ring) && match_term(dag, dag[id].operands[1], ring);
}

}  // namespace

std::optional<Ring> match_ring(const Dag& dag, NodeId relation) {
  const DagNode& root = dag[relation];
  if (root.op != Op::less && root.op != Op::less_equal && root.op != Op::equal) return std::nullopt;
  for (int side = 0; side < (root.op == Op::equal ? 2 : 1); ++side) {
    const NodeId norm = root.operands[static_cast<std::size_t>(side)];
    Ring ring{root.op, 0, {}, {}, {}, root.operands[static_cast<std::size_t>(1 - side)]};
    if (dag[norm].op != Op::sqrt || depends_on_point(dag, ring.radius)) continue;
    if (match_sum(dag, dag[norm].operands[0], ring) && ring.dim >= 2) return ring;
  }
  return std::nullopt;
}

DiscZone::DiscZone(const Grid& grid, const Ring& ring, const std::array<Interval, 3>& center,
                   const Interval& radius, Brush brush)
    : grid_(grid), ring_(ring), center_(center), radius_(radius), brush_(brush) {
  // The general path compares roots: sqrt(s) < r. The root is monotone, so the greatest s whose upward root
  // passes, and the least s whose downward root fails, decide the same with no root taken.
  const bool strict = ring.relation == Op::less;
  const auto passes = [&](double s) {
    return strict ? std::sqrt(s) < radius.lo() : std::sqrt(s) <= radius.lo();
  };
  const auto fails = [&](double s) {
    return strict ? up::sqrt_down(s) >= radius.hi() : up::sqrt_down(s) > radius.hi();
  };
  all_up_to_ = -1.0;
  if (radius.lo() == kInfinity || radius.is_empty()) {
    all_up_to_ = -1.0;
  } else if (passes(0.0)) {
    all_up_to_ = radius.lo() * radius.lo();
    while (!passes(all_up_to_)) all_up_to_ = up::next_down(all_up_to_);
    while (all_up_to_ < kInfinity && passes(up::next_up(all_up_to_))) all_up_to_ = up::next_up(all_up_to_);
  }
  none_from_ = kInfinity;
  if (radius.is_empty() || fails(0.0)) {
    none_from_ = 0.0;
  } else if (radius.hi() < kInfinity) {
    none_from_ = radius.hi() * radius.hi();
    while (!fails(none_from_)) none_from_ = up::next_up(none_from_);
    while (fails(up::next_down(none_from_))) none_from_ = up::next_down(none_from_);
  }
}

Region DiscZone::inner_bounds() const {
  Region region;
  for (std::size_t k = 0; k < ring_.dim; ++k) {
    const double lo = up::sub_down(center_[k].hi(), radius_.lo()), hi = center_[k].lo() + radius_.lo();
    if (!(lo <= hi)) return {};
    region.lo[ring_.axis[k]] = grid_.cell_of(lo);
    region.hi[ring_.axis[k]] = grid_.cell_of(hi) + 1;
  }
  return region;
}

// Along one term's axis, for each layer of children, squares of distances from the centers: the greatest of
// its points, and what decides whether it holds cells to settle. With the inner brush that is the least
// greatest distance of its cells, rounded upward as theirs is; with the outer one the least distance of its
// points, negated so that upward sums round it down.
struct DiscZone::Distances {
  std::array<double, 8> greatest{};
  std::array<double, 8> some{};
};

void DiscZone::measure_children(std::size_t k, const CellIndex& origin, std::int64_t child_edge,
                                Distances& distances) const {
  // Eight layers in any dimension, in plain loops that vectorise; in space the last four are not used.
  const std::int64_t first = origin[ring_.axis[k]];
  const auto line = grid_.lines<9>(first, child_edge);
  const double low = center_[k].lo(), high = center_[k].hi();
  const auto greater = [](double x, double y) { return x > y ? x : y; };
  for (std::size_t i = 0; i < 8; ++i) {
    const double greatest = greater(line[i + 1] - low, high - line[i]);
    distances.greatest[i] = greatest * greatest;
  }
  if (brush_ == Brush::outer) {
    for (std::size_t i = 0; i < 8; ++i) {
      const double least = greater(greater(-(high - line[i]), -(line[i + 1] - low)), 0.0);
      distances.some[i] = -least * least;
    }
  } else if (child_edge > 1) {
    // With centers [l, h] the farthest is at least (h - l) / 2 away from any point.
    const double spread = greater(up::next_down(-0.5 * (low - high)), 0.0);
    const auto top_of_first = grid_.lines<8>(first + 1, child_edge);
    const auto bottom_of_last = grid_.lines<8>(first + child_edge - 1, child_edge);
    for (std::size_t i = 0; i < 8; ++i) {
      const double some = greater(greater(top_of_first[i] - low, high - bottom_of_last[i]), spread);
      distances.some[i] = some * some;
    }
  }
}

ChildDecisions DiscZone::decide_children(const CellIndex& origin, std::int64_t child_edge,
                                         std::uint64_t /*open*/) const {
  std::array<Distances, 3> distances;
  for (std::size_t k = 0; k < ring_.dim; ++k) measure_children(k, origin, child_edge, distances[k]);
  const bool cells = child_edge == 1;
  const bool asks_some = brush_ == Brush::outer || !cells;
  ChildDecisions decisions =
      ring_.dim == 2 ? decide_plane(distances, asks_some) : decide_space(distances, asks_some);
  if (cells)
    decisions.all |= decisions.some;  // with the outer brush, a cell that may hold a point is painted
  return decisions;
}

// Eight rows of eight. Two terms add up to the same in either order.
ChildDecisions DiscZone::decide_plane(const std::array<Distances, 3>& distances, bool asks_some) const {
  const Distances& along = distances[ring_.axis[0] == 0 ? 0 : 1];
  const Distances& across = distances[ring_.axis[0] == 0 ? 1 : 0];
  ChildDecisions decisions;
  for (std::size_t j = 0; j < 8; ++j) {
    decisions.all |= sums_at_most(along.greatest.data(), across.greatest[j], all_up_to_) << (8 * j);
  }
  const bool outer = brush_ == Brush::outer;
  // Outer: the least is below none_from where the negated sum is not at most -none_from.
  const double limit = outer ? -none_from_ : all_up_to_;
  for (std::size_t j = 0; j < 8 && asks_some; ++j) {
    const std::uint64_t row = sums_at_most(along.some.data(), across.some[j], limit);
    decisions.some |= (outer ? ~row & 0xff : row) << (8 * j);
  }
  return decisions;
}

// Four layers of four rows of four, summed in the order of the terms, as the general path adds them.
ChildDecisions DiscZone::decide_space(const std::array<Distances, 3>& distances, bool asks_some) const {
  ChildDecisions decisions;
  const bool outer = brush_ == Brush::outer;
  for (std::size_t place = 0; place < 64; ++place) {
    const std::size_t i = place % 4, j = place / 4 % 4, h = place / 16;
    const std::size_t bit =
        (i << (2 * ring_.axis[0])) + (j << (2 * ring_.axis[1])) + (h << (2 * ring_.axis[2]));
    const double greatest = (distances[0].greatest[i] + distances[1].greatest[j]) + distances[2].greatest[h];
    const double some = (distances[0].some[i] + distances[1].some[j]) + distances[2].some[h];
    decisions.all |= static_cast<std::uint64_t>(greatest <= all_up_to_) << bit;
    const bool may = outer ? some > -none_from_ : some <= all_up_to_;
    decisions.some |= static_cast<std::uint64_t>(asks_some && may) << bit;
  }
  return decisions;
}

}  // namespace hcsp
