// SPDX-License-Identifier: Apache-2.0
// The cells of a set interval as boxes, and their volume.
#include <algorithm>
#include <tuple>

#include "domains/interval/kernel.h"
#include "domains/rounding.h"
#include "domains/set_interval.h"

namespace hcsp {

namespace {

// Joins boxes that touch along one axis and agree along the others.
void merge_along(std::vector<Region>& boxes, std::size_t axis) {
  const std::size_t b = (axis + 1) % 3, c = (axis + 2) % 3;
  const auto cross_section = [b, c](const Region& r) {
    return std::tuple(r.lo[c], r.hi[c], r.lo[b], r.hi[b]);
  };
  std::sort(boxes.begin(), boxes.end(), [&](const Region& x, const Region& y) {
    return std::tuple(cross_section(x), x.lo[axis]) < std::tuple(cross_section(y), y.lo[axis]);
  });
  std::size_t kept = 0;
  for (std::size_t i = 1; i < boxes.size(); ++i) {
    Region& last = boxes[kept];
    if (cross_section(last) == cross_section(boxes[i]) && last.hi[axis] == boxes[i].lo[axis]) {
      last.hi[axis] = boxes[i].hi[axis];
    } else {
      boxes[++kept] = boxes[i];
    }
  }
  if (!boxes.empty()) boxes.resize(kept + 1);
}

std::uint64_t cells_in(CellState state, std::uint64_t lower, std::uint64_t upper) {
  switch (state) {
    case CellState::outside:
      return ~lower & ~upper;
    case CellState::unknown:
      return ~lower & upper;
    case CellState::inside:
      return lower & upper;
    case CellState::contradiction:
      return lower & ~upper;
  }
  return 0;
}

}  // namespace

// Runs of uniform children in a state, row by row.
void SetInterval::collect_runs(std::uint32_t node, std::int64_t child_edge, const CellIndex& origin,
                               CellState state, std::vector<Region>& runs) const {
  const Node& at = nodes_[node];
  const std::uint64_t found = cells_in(state, at.lower, at.upper) & ~at.mixed;
  for (int first = 0; first < 64; first += static_cast<int>(side())) {
    for (int bit = first; bit < first + side(); ++bit) {
      if (((found >> bit) & 1U) == 0) continue;
      Region run = Region::block(child_place(origin, child_edge, bit), child_edge, dim());
      for (; bit + 1 < first + side() && ((found >> (bit + 1)) & 1U) != 0; ++bit) run.hi[0] += child_edge;
      runs.push_back(run);
    }
  }
  for (std::uint64_t rest = at.mixed; rest != 0; rest &= rest - 1) {
    const int bit = __builtin_ctzll(rest);
    collect_runs(children_[at.children][static_cast<std::size_t>(bit)], child_edge / side(),
                 child_place(origin, child_edge, bit), state, runs);
  }
}

std::vector<Region> SetInterval::cells(CellState state) const {
  std::vector<Region> boxes;
  if (empty_) return boxes;
  collect_runs(root_, root_edge() / side(), origin_, state, boxes);
  for (std::size_t axis = 0; axis < dim(); ++axis) merge_along(boxes, axis);
  return boxes;
}

std::vector<std::vector<double>> SetInterval::boxes(CellState state) const {
  std::vector<std::vector<double>> boxes;
  for (const Region& region : cells(state)) {
    std::vector<double> box;
    for (std::size_t axis = 0; axis < dim(); ++axis) {
      box.push_back(grid_.line(region.lo[axis]));
      box.push_back(grid_.line(region.hi[axis]));
    }
    boxes.push_back(std::move(box));
  }
  return boxes;
}

double SetInterval::volume_of(const std::vector<Region>& cells, bool upward) const {
  RoundUpward guard;
  Interval volume(0.0);
  for (const Region& region : cells) {
    Interval product(1.0);
    for (std::size_t axis = 0; axis < dim(); ++axis) {
      const Interval lo(grid_.line(region.lo[axis])), hi(grid_.line(region.hi[axis]));
      product = up::mul(product, up::sub(hi, lo));
    }
    volume = up::add(volume, product);
  }
  return upward ? volume.hi() : std::max(volume.lo(), 0.0);
}

double SetInterval::lower_volume() const {
  if (background_.lower != 0) return kInfinity;
  return volume_of(cells(CellState::inside), false);
}

double SetInterval::upper_volume() const {
  if (background_.upper != 0) return kInfinity;
  std::vector<Region> upper = cells(CellState::inside);
  const std::vector<Region> unknown = cells(CellState::unknown);
  upper.insert(upper.end(), unknown.begin(), unknown.end());
  return volume_of(upper, true);
}

double measure(const SetInterval& a) {
  if (a.is_empty()) return 0.0;
  if (a.background() == CellState::unknown) return kInfinity;
  double open = 0.0;
  for (const std::vector<double>& box : a.boxes(CellState::unknown)) {
    double volume = 1.0;
    for (std::size_t axis = 0; axis < a.dim(); ++axis) volume *= box[2 * axis + 1] - box[2 * axis];
    open += volume;
  }
  return open;
}

}  // namespace hcsp
