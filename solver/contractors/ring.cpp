// SPDX-License-Identifier: Apache-2.0
#include "solver/contractors/ring.h"

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
    const NodeId point = difference.operands[point_first ? 0 : 1], center = difference.operands[point_first ? 1 : 0];
    if (dag[point].op != Op::input || dag[point].input.kind != Input::Kind::point || depends_on_point(dag, center)) continue;
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

DiscZone::DiscZone(const Grid& grid, const Ring& ring, const std::array<Interval, 3>& center, const Interval& radius,
                   Brush brush)
    : grid_(grid), ring_(ring), center_(center), radius_(radius), brush_(brush) {
  // The general path compares roots: sqrt(s) < r. The root is monotone, so the greatest s whose upward root passes, and
  // the least s whose downward root fails, decide the same with no root taken.
  const bool strict = ring.relation == Op::less;
  const auto passes = [&](double s) { return strict ? std::sqrt(s) < radius.lo() : std::sqrt(s) <= radius.lo(); };
  const auto fails = [&](double s) { return strict ? up::sqrt_down(s) >= radius.hi() : up::sqrt_down(s) > radius.hi(); };
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

// Whether no cell of a block lies in the discs of all centers: even the point of the block that is nearest to its
// farthest center is too far. Along an axis, with centers [l, h], the farthest is max(a - l, h - a) away from a.
bool DiscZone::too_far(const CellIndex& lo, std::int64_t edge) const {
  double minus_sum = 0.0;  // negated: upward rounding makes it a lower bound
  for (std::size_t k = 0; k < ring_.dim; ++k) {
    const Interval side = block_side(grid_, lo, edge, ring_.axis[k]);
    const double low = center_[k].lo(), high = center_[k].hi();
    const double spread = -0.5 * (low - high);
    const double farthest = std::max({up::sub_down(side.lo(), low), up::sub_down(high, side.hi()), up::next_down(spread)});
    if (farthest > 0) minus_sum += -farthest * farthest;
  }
  return -minus_sum > all_up_to_;
}

Decision DiscZone::decide(const CellIndex& lo, std::int64_t edge) const {
  if (brush_ == Brush::inner && too_far(lo, edge)) return Decision::none;
  Interval sum = squared(0, lo, edge);
  for (std::size_t k = 1; k < ring_.dim; ++k) sum = up::add(sum, squared(k, lo, edge));
  if (sum.hi() <= all_up_to_) return Decision::all;
  if (sum.lo() >= none_from_) return Decision::none;
  return brush_ == Brush::outer && edge == 1 ? Decision::all : Decision::split;
}

// The bound that decides at the tile's columns along one term's axis: of the farthest squared distance for the inner
// brush, of the nearest for the outer, negated so that upward sums round it down.
void DiscZone::column_bounds(std::size_t k, const CellIndex& lo, std::size_t side, double* bound) const {
  std::array<double, 9> line{};
  for (std::size_t i = 0; i <= side; ++i) line[i] = grid_.line(lo[ring_.axis[k]] + static_cast<std::int64_t>(i));
  const double low = center_[k].lo(), high = center_[k].hi();
  if (brush_ == Brush::inner) {
    for (std::size_t i = 0; i < side; ++i) {
      const double farthest = std::max(line[i + 1] - low, high - line[i]);
      bound[i] = farthest * farthest;
    }
  } else {
    for (std::size_t i = 0; i < side; ++i) {
      const double nearest = std::max({up::sub_down(line[i], high), up::sub_down(low, line[i + 1]), 0.0});
      bound[i] = -nearest * nearest;
    }
  }
}

std::uint64_t DiscZone::decide_tile(const CellIndex& lo) const {
  const bool inner = brush_ == Brush::inner;
  const std::size_t side = ring_.dim == 2 ? 8 : 4;
  const int bits = ring_.dim == 2 ? 3 : 2;
  if (inner && too_far(lo, static_cast<std::int64_t>(side))) return 0;
  // By axis, so that a row of the tile is contiguous in bits; addition commutes, so the sum's order does not matter in
  // the plane, and in space it is that of the terms.
  std::array<std::array<double, 8>, 3> bound{};
  for (std::size_t k = 0; k < ring_.dim; ++k) column_bounds(k, lo, side, bound[k].data());
  const double limit = inner ? all_up_to_ : std::nextafter(none_from_, 0.0);
  std::array<int, 3> shift{};
  for (std::size_t k = 0; k < ring_.dim; ++k) shift[k] = bits * static_cast<int>(ring_.axis[k]);
  std::uint64_t cells = 0;
  for (std::size_t h = 0; h < (ring_.dim == 2 ? 1 : side); ++h) {
    const double third = ring_.dim == 2 ? 0.0 : bound[2][h];
    for (std::size_t j = 0; j < side; ++j) {
      for (std::size_t i = 0; i < side; ++i) {
        const double sum = (bound[0][i] + bound[1][j]) + third;
        const bool in = inner ? sum <= limit : -sum <= limit;
        cells |= static_cast<std::uint64_t>(in) << ((i << shift[0]) + (j << shift[1]) + (h << shift[2]));
      }
    }
  }
  return cells;
}

}  // namespace hcsp
