// SPDX-License-Identifier: Apache-2.0
#include "domains/set_interval.h"

#include <algorithm>

#include "domains/check.h"
#include "domains/set_descent.h"

namespace hcsp {

namespace {

constexpr std::uint64_t kAll = ~std::uint64_t{0};

Planes uniform_planes(const Planes& planes, int bit) {
  return {((planes.lower >> bit) & 1U) != 0 ? kAll : 0, ((planes.upper >> bit) & 1U) != 0 ? kAll : 0};
}

CellState state_of(const Planes& planes, int bit) {
  const bool lower = ((planes.lower >> bit) & 1U) != 0;
  const bool upper = ((planes.upper >> bit) & 1U) != 0;
  return lower ? (upper ? CellState::inside : CellState::contradiction)
               : (upper ? CellState::unknown : CellState::outside);
}

int log2(std::int64_t power_of_two) { return __builtin_ctzll(static_cast<std::uint64_t>(power_of_two)); }

// The lowest bits, one a layer along an axis.
constexpr std::uint64_t mask_of_layers(std::int64_t side) {
  return side == 64 ? kAll : (std::uint64_t{1} << side) - 1;
}

// The part of a block's cells at the origin of its node, as a mask of children: part children along an axis.
constexpr std::uint64_t mask_at_origin(std::size_t dim, int axis_bits, std::int64_t part) {
  std::uint64_t mask = mask_of_layers(part);
  for (std::size_t axis = 1; axis < dim; ++axis) {
    const std::uint64_t row = mask;
    const int stride = axis_bits * static_cast<int>(axis);
    for (std::int64_t i = 1; i < part; ++i) mask |= row << (i << stride);
  }
  return mask;
}

using MaskTable = std::array<std::array<std::uint64_t, 7>, 4>;

constexpr MaskTable make_masks() {
  MaskTable table{};
  for (std::size_t dim = 1; dim <= 3; ++dim) {
    const int bits = 6 / static_cast<int>(dim);
    for (int log = 0; log <= bits; ++log)
      table[dim][static_cast<std::size_t>(log)] = mask_at_origin(dim, bits, std::int64_t{1} << log);
  }
  return table;
}

constexpr MaskTable kMasks = make_masks();

// By dimension and axis: the first bit of every group of side^(axis + 1) children.
constexpr std::array<std::array<std::uint64_t, 3>, 4> kEveryGroup{
    {{}, {1}, {0x0101010101010101, 1}, {0x1111111111111111, 0x0001000100010001, 1}}};

// The cells that the closed frame touches: half-open cells, so a face at line(i) touches cell i.
Region touched_cells(const Grid& grid, const Box& frame) {
  require(static_cast<std::size_t>(frame.dim()) == grid.dim(), "SetInterval: a frame of dimension {} in R^{}",
          frame.dim(), grid.dim());
  Region region;
  const double reach = grid.line(Grid::kReach);
  for (std::size_t axis = 0; axis < grid.dim(); ++axis) {
    const Interval& side = frame[static_cast<Eigen::Index>(axis)];
    require(side.lo() < side.hi(), "SetInterval: the frame {} has no volume", to_string(frame));
    require(-reach < side.lo() && side.hi() < reach,
            "SetInterval: the frame {} is beyond the addressable cells of {}", to_string(frame),
            grid.precision());
    region.lo[axis] = grid.cell_of(side.lo());
    region.hi[axis] = grid.cell_of(side.hi()) + 1;
  }
  return region;
}

}  // namespace

void Region::join(const Region& other) {
  beyond = beyond || other.beyond;
  if (!other.has_cells()) return;
  if (!has_cells()) {
    lo = other.lo;
    hi = other.hi;
    return;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    lo[axis] = std::min(lo[axis], other.lo[axis]);
    hi[axis] = std::max(hi[axis], other.hi[axis]);
  }
}

bool Region::meets(const Region& other, std::size_t dim) const {
  for (std::size_t axis = 0; axis < dim; ++axis) {
    if (other.lo[axis] >= hi[axis] || other.hi[axis] <= lo[axis]) return false;
  }
  return true;
}

bool Region::holds(const Region& other, std::size_t dim) const {
  for (std::size_t axis = 0; axis < dim; ++axis) {
    if (other.lo[axis] < lo[axis] || other.hi[axis] > hi[axis]) return false;
  }
  return true;
}

Region Region::common(const Region& other, std::size_t dim) const {
  Region both;
  for (std::size_t axis = 0; axis < dim; ++axis) {
    both.lo[axis] = std::max(lo[axis], other.lo[axis]);
    both.hi[axis] = std::min(hi[axis], other.hi[axis]);
  }
  return both;
}

Region Region::block(const CellIndex& lo, std::int64_t edge, std::size_t dim) {
  Region region;
  region.lo = lo;
  for (std::size_t axis = 0; axis < dim; ++axis) region.hi[axis] = lo[axis] + edge;
  return region;
}

// Decides all that is outside a box of cells.
struct SetInterval::OutsideOf {
  const SetInterval& set;
  const Region& cells;
  ChildDecisions decide_children(const CellIndex& origin, std::int64_t child_edge, std::uint64_t) const {
    return {~set.children_within(cells, origin, child_edge, false),
            ~set.children_within(cells, origin, child_edge, true)};
  }
};

SetInterval::SetInterval(std::size_t dim, double precision, const std::optional<Box>& frame)
    : grid_(dim, precision), background_{0, kAll} {
  root_ = new_node(background_);
  place_root();
  if (!frame) return;
  const Region cells = touched_cells(grid_, *frame);
  Region margin = cells;  // a rim of outside cells, so that contractors see where the frame ends
  for (std::size_t axis = 0; axis < dim; ++axis) {
    --margin.lo[axis];
    ++margin.hi[axis];
  }
  cover(margin);
  OutsideOf zone{*this, cells};
  exclude(reach(), zone);
  exclude_background();
}

CellState SetInterval::background() const { return state_of(background_, 0); }

CellState SetInterval::at(const double* point) const {
  CellIndex cell{};
  for (std::size_t axis = 0; axis < dim(); ++axis) cell[axis] = grid_.cell_of(point[axis]);
  return at_cell(cell);
}

CellState SetInterval::at_cell(const CellIndex& cell) const {
  std::array<std::uint64_t, 3> place{};
  for (std::size_t axis = 0; axis < dim(); ++axis) {
    place[axis] = static_cast<std::uint64_t>(cell[axis] - origin_[axis]);
    if (place[axis] >= static_cast<std::uint64_t>(root_edge())) return background();
  }
  std::uint32_t node = root_;
  const int bits = axis_bits();
  const std::uint64_t digit = static_cast<std::uint64_t>(side()) - 1;
  for (int shift = bits * (levels_ - 1);; shift -= bits) {
    std::uint64_t bit = place[0] >> shift & digit;
    if (dim() > 1) bit |= (place[1] >> shift & digit) << bits;
    if (dim() > 2) bit |= (place[2] >> shift & digit) << 2 * bits;
    const Node& at = nodes_[node];
    if ((at.mixed >> bit & 1U) == 0) return state_of({at.lower, at.upper}, static_cast<int>(bit));
    node = children_[at.children][bit];
  }
}

Region SetInterval::exclude_background() {
  Region delta;
  delta.beyond = background_.upper != 0;
  if (background_.lower != 0) empty_ = true;
  background_.upper = 0;
  return delta;
}

Region SetInterval::everywhere() {
  Region region;
  region.lo.fill(-Grid::kReach);
  region.hi.fill(Grid::kReach);
  region.beyond = true;
  return region;
}

bool SetInterval::has_outside() const {
  return background_.upper == 0 || has_cell(root_, kAll, CellState::outside);
}

// ---- The tree ----

// A tree of L levels covers side^L cells along an axis from -o, where o has the digit side / 2 at each of its
// L places in base `side`. So a taller tree holds the shorter one as one of its blocks, and 0 stays well
// inside.
void SetInterval::place_root() {
  const std::int64_t below = (side() / 2) * ((root_edge() - 1) / (side() - 1));
  for (std::size_t axis = 0; axis < dim(); ++axis) origin_[axis] = -below;
}

Region SetInterval::reach() const { return Region::block(origin_, root_edge(), dim()); }

std::uint64_t SetInterval::part_mask(std::int64_t part, int bit) const {
  return kMasks[dim()][static_cast<std::size_t>(log2(part))] << bit;
}

CellIndex SetInterval::child_place(const CellIndex& origin, std::int64_t child_edge, int bit) const {
  CellIndex place = origin;
  for (std::size_t axis = 0; axis < dim(); ++axis) {
    place[axis] += ((bit >> (axis_bits() * static_cast<int>(axis))) & (side() - 1)) * child_edge;
  }
  return place;
}

// How far the bit of a part's corner is from its first child's bit: corner is one bit an axis, in units of
// the part.
int SetInterval::part_bit(std::int64_t part, int corner) const {
  int bit = 0;
  for (std::size_t axis = 0; axis < dim(); ++axis) {
    if (((corner >> axis) & 1) != 0) bit += static_cast<int>(part << (axis_bits() * static_cast<int>(axis)));
  }
  return bit;
}

void SetInterval::sum_up(Block& block) const {
  if (block.node == kNoNode) return;
  const Node& node = nodes_[block.node];
  block.any_upper = (node.upper & block.mask) != 0;
  block.all_lower = (node.lower & block.mask) == block.mask;
  block.all_upper = (node.upper & block.mask) == block.mask && (node.mixed & block.mask) == 0;
  if (block.edge == block.child_edge && block.child_edge > 1) {  // one child: go down to it
    if ((node.mixed & block.mask) != 0) {
      block.node = children_[node.children][static_cast<std::size_t>(__builtin_ctzll(block.mask))];
      block.node_lo = block.lo;
      block.mask = kAll;
      block.child_edge >>= axis_bits();
    } else {
      block.node = kNoNode;
    }
  }
}

// The children of a node that meet a box of cells, or lie wholly in it: along each axis a run of layers.
std::uint64_t SetInterval::children_within(const Region& bounds, const CellIndex& origin,
                                           std::int64_t child_edge, bool wholly) const {
  const int log_edge = log2(child_edge);
  const std::int64_t round_up = child_edge - 1, most = side();
  std::uint64_t children = kAll;
  for (std::size_t axis = 0; axis < dim(); ++axis) {
    const std::int64_t lo = bounds.lo[axis] - origin[axis], hi = bounds.hi[axis] - origin[axis];
    const std::int64_t first = std::max<std::int64_t>((wholly ? lo + round_up : lo) >> log_edge, 0);
    const std::int64_t last = std::min<std::int64_t>((wholly ? hi : hi + round_up) >> log_edge, most);
    if (first >= last) return 0;
    const int stride = axis_bits() * static_cast<int>(axis);
    // The run within the first group of layers of this axis, then in every group.
    const std::uint64_t run = (mask_of_layers(last << stride)) & ~mask_of_layers(first << stride);
    children &= run * kEveryGroup[dim()][axis];
  }
  return children;
}

// The box around some children of a node: layer by layer along the last axis, then all layers folded into
// one.
Region SetInterval::bounds_of(std::uint64_t children, const CellIndex& origin,
                              std::int64_t child_edge) const {
  Region region;
  const auto bound = [&](std::size_t axis, std::uint64_t bits, int layer) {
    region.lo[axis] = origin[axis] + (__builtin_ctzll(bits) >> layer) * child_edge;
    region.hi[axis] = origin[axis] + (((63 - __builtin_clzll(bits)) >> layer) + 1) * child_edge;
  };
  switch (dim()) {
    case 1:
      bound(0, children, 0);
      break;
    case 2:
      bound(1, children, 3);
      children |= children >> 32;
      children |= children >> 16;
      bound(0, (children | children >> 8) & 0xff, 0);
      break;
    default:
      bound(2, children, 4);
      children |= children >> 32;
      children = (children | children >> 16) & 0xffff;
      bound(1, children, 2);
      children |= children >> 8;
      bound(0, (children | children >> 4) & 0xf, 0);
      break;
  }
  return region;
}

Region SetInterval::upper_bounds(const Block& block) const {
  if (block.node == kNoNode) return Region::block(block.lo, block.edge, dim());
  return bounds_of(nodes_[block.node].upper & block.mask, block.node_lo, block.child_edge);
}

SetInterval::Block SetInterval::root() const {
  Block block;
  block.lo = block.node_lo = origin_;
  block.edge = root_edge();
  block.node = root_;
  block.mask = kAll;
  block.child_edge = root_edge() / side();
  sum_up(block);
  return block;
}

std::uint64_t SetInterval::mask_of_part(const Block& block, int corner) const {
  const std::int64_t children = (block.edge >> log2(block.child_edge)) / 2;
  return part_mask(children, __builtin_ctzll(block.mask) + part_bit(children, corner));
}

SetInterval::Block SetInterval::part(const Block& block, int corner) const {
  return part(block, corner, block.node == kNoNode ? 0 : mask_of_part(block, corner));
}

SetInterval::Block SetInterval::part(const Block& block, int corner, std::uint64_t mask) const {
  Block part = block;
  part.edge = block.edge / 2;
  part.mask = mask;
  for (std::size_t axis = 0; axis < dim(); ++axis) part.lo[axis] += ((corner >> axis) & 1) * part.edge;
  sum_up(part);
  return part;
}

std::uint32_t SetInterval::new_node(Planes uniform) {
  std::uint32_t id = 0;
  if (free_nodes_.empty()) {
    id = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
  } else {
    id = free_nodes_.back();
    free_nodes_.pop_back();
  }
  Node& node = nodes_[id];
  node.lower = uniform.lower;
  node.upper = uniform.upper;
  node.mixed = 0;
  return id;
}

// The node of a child; a uniform child gets one.
std::uint32_t SetInterval::child(std::uint32_t node, int bit) {
  const std::uint64_t flag = std::uint64_t{1} << bit;
  if (nodes_[node].children == kNoNode) {
    nodes_[node].children = static_cast<std::uint32_t>(children_.size());
    children_.emplace_back();
  }
  if ((nodes_[node].mixed & flag) == 0) {
    const std::uint32_t made = new_node(uniform_planes({nodes_[node].lower, nodes_[node].upper}, bit));
    nodes_[node].mixed |= flag;
    children_[nodes_[node].children][static_cast<std::size_t>(bit)] = made;
  }
  return children_[nodes_[node].children][static_cast<std::size_t>(bit)];
}

// A freed node keeps its array of children for its next use.
void SetInterval::free_node(std::uint32_t node) {
  for (std::uint64_t rest = nodes_[node].mixed; rest != 0; rest &= rest - 1) {
    free_node(children_[nodes_[node].children][static_cast<std::size_t>(__builtin_ctzll(rest))]);
  }
  nodes_[node].mixed = 0;
  free_nodes_.push_back(node);
}

// Sums a child that has changed up into its parent, and drops its node where it has become uniform.
void SetInterval::refresh(std::uint32_t node, int bit) {
  const std::uint64_t flag = std::uint64_t{1} << bit;
  const std::uint32_t id = children_[nodes_[node].children][static_cast<std::size_t>(bit)];
  const Node& child = nodes_[id];
  const bool uniform = child.mixed == 0 && (child.lower == 0 || child.lower == kAll) &&
                       (child.upper == 0 || child.upper == kAll);
  Node& parent = nodes_[node];
  parent.lower = child.lower == kAll ? parent.lower | flag : parent.lower & ~flag;
  parent.upper = child.upper != 0 ? parent.upper | flag : parent.upper & ~flag;
  if (uniform) {
    parent.mixed &= ~flag;
    free_node(id);
  }
}

void SetInterval::grow_to(int levels) {
  while (levels_ < levels) {
    const std::uint32_t old_root = root_;
    const std::uint32_t new_root = new_node(background_);
    const int middle = part_bit(side() / 2, (1 << dim()) - 1);
    const std::uint32_t placeholder = child(new_root, middle);
    children_[nodes_[new_root].children][static_cast<std::size_t>(middle)] = old_root;
    free_node(placeholder);
    root_ = new_root;
    ++levels_;
    place_root();
    refresh(root_, middle);
  }
}

void SetInterval::cover(const Region& cells) {
  const auto covered = [&] {
    const Region mine = reach();
    for (std::size_t axis = 0; axis < dim(); ++axis) {
      const std::int64_t lo = std::max(cells.lo[axis], -Grid::kReach),
                         hi = std::min(cells.hi[axis], Grid::kReach);
      if (lo < mine.lo[axis] || hi > mine.hi[axis]) return false;
    }
    return true;
  };
  while (!covered()) grow_to(levels_ + 1);
}

bool SetInterval::has_cell(std::uint32_t node, std::uint64_t mask, CellState state) const {
  const Node& at = nodes_[node];
  const std::uint64_t uniform = mask & ~at.mixed;
  const std::uint64_t found = state == CellState::outside ? ~at.upper : at.lower;
  if ((found & uniform) != 0) return true;
  for (std::uint64_t rest = at.mixed & mask; rest != 0; rest &= rest - 1) {
    if (has_cell(children_[at.children][static_cast<std::size_t>(__builtin_ctzll(rest))], kAll, state))
      return true;
  }
  return false;
}

// ---- Cell-by-cell operations ----

struct SetInterval::View {
  const SetInterval& set;
  std::uint32_t node;  // kNoNode: uniform
  Planes uniform;

  [[nodiscard]] Planes planes() const {
    return node == kNoNode ? uniform : Planes{set.nodes_[node].lower, set.nodes_[node].upper};
  }
  [[nodiscard]] std::uint64_t mixed() const { return node == kNoNode ? 0 : set.nodes_[node].mixed; }
  [[nodiscard]] View child(int bit) const {
    if (((mixed() >> bit) & 1U) == 0) return {set, kNoNode, uniform_planes(planes(), bit)};
    return {set, set.children_[set.nodes_[node].children][static_cast<std::size_t>(bit)], {}};
  }
};

void SetInterval::combine_node(std::uint32_t node, const View& source, std::int64_t child_edge,
                               const CellIndex& origin, WordOperation op, const Region& where,
                               Region& delta) {
  if (source.node == kNoNode) {
    // A uniform source that leaves each of the four states alone leaves everything alone.
    constexpr Planes kStates{0b1100, 0b1010};
    const Planes after = op(kStates, source.uniform);
    if ((after.lower & 0xf) == kStates.lower && (after.upper & 0xf) == kStates.upper) return;
  }
  const Planes before{nodes_[node].lower, nodes_[node].upper};
  const std::uint64_t mixed = nodes_[node].mixed | source.mixed();
  const Planes after = op(before, source.planes());
  const std::uint64_t changed = ((before.lower ^ after.lower) | (before.upper ^ after.upper)) & ~mixed;
  nodes_[node].lower = (before.lower & mixed) | (after.lower & ~mixed);
  nodes_[node].upper = (before.upper & mixed) | (after.upper & ~mixed);
  if ((after.lower & ~after.upper & ~mixed) != 0) empty_ = true;
  for (std::uint64_t rest = changed; rest != 0; rest &= rest - 1) {
    delta.join(Region::block(child_place(origin, child_edge, __builtin_ctzll(rest)), child_edge, dim()));
  }
  for (std::uint64_t rest = mixed; rest != 0; rest &= rest - 1) {
    const int bit = __builtin_ctzll(rest);
    const CellIndex lo = child_place(origin, child_edge, bit);
    if (!where.meets(Region::block(lo, child_edge, dim()), dim())) continue;
    combine_node(child(node, bit), source.child(bit), child_edge / side(), lo, op, where, delta);
    refresh(node, bit);
  }
}

Region combine(SetInterval& target, const SetInterval& source, SetInterval::WordOperation op,
               const Region& where) {
  require(target.grid_ == source.grid_, "SetInterval: grids differ (precisions {} and {})",
          target.precision(), source.precision());
  HCSP_ASSERT(!target.empty_ && !source.empty_);
  if (source.levels_ < target.levels_) {
    SetInterval grown = source;
    grown.grow_to(target.levels_);
    return combine(target, grown, op, where);
  }
  target.grow_to(source.levels_);
  Region delta;
  target.combine_node(target.root_, {source, source.root_, {}}, target.root_edge() / target.side(),
                      target.origin_, op, where, delta);
  const Planes background = op(target.background_, source.background_);
  delta.beyond = !(background == target.background_);
  target.background_ = background;
  if ((background.lower & ~background.upper) != 0) target.empty_ = true;
  return delta;
}

namespace {

SetInterval combined(const SetInterval& a, const SetInterval& b, SetInterval::WordOperation op) {
  SetInterval result = a;
  combine(result, b, op, SetInterval::everywhere());
  return result;
}

SetInterval strict(const SetInterval& a, const SetInterval& b, SetInterval::WordOperation op) {
  if (a.is_empty() || b.is_empty()) return bottom(a);
  return combined(a, b, op);
}

Planes meet_words(Planes a, Planes b) { return {a.lower | b.lower, a.upper & b.upper}; }
Planes join_words(Planes a, Planes b) { return {a.lower & b.lower, a.upper | b.upper}; }

}  // namespace

Region contract(SetInterval& a, const SetInterval& b) {
  if (a.is_empty()) return {};
  if (b.is_empty()) {
    a = bottom(a);
    return everything(a);
  }
  return combine(a, b, meet_words, SetInterval::everywhere());
}

SetInterval meet(const SetInterval& a, const SetInterval& b) { return strict(a, b, meet_words); }

SetInterval join(const SetInterval& a, const SetInterval& b) {
  if (a.is_empty()) return b;
  if (b.is_empty()) return a;
  return combined(a, b, join_words);
}

bool leq(const SetInterval& a, const SetInterval& b) {
  if (a.is_empty()) return true;
  if (b.is_empty()) return false;
  SetInterval met = a;
  return contract(met, b).is_none();
}

bool operator==(const SetInterval& a, const SetInterval& b) {
  return a.grid() == b.grid() && leq(a, b) && leq(b, a);
}

SetInterval top(const SetInterval& a) { return {a.dim(), a.precision()}; }

SetInterval bottom(const SetInterval& a) {
  SetInterval empty(a.dim(), a.precision());
  empty.empty_ = true;
  return empty;
}

SetInterval set_union(const SetInterval& a, const SetInterval& b) {
  return strict(a, b, [](Planes x, Planes y) { return Planes{x.lower | y.lower, x.upper | y.upper}; });
}

SetInterval set_intersection(const SetInterval& a, const SetInterval& b) {
  return strict(a, b, [](Planes x, Planes y) { return Planes{x.lower & y.lower, x.upper & y.upper}; });
}

SetInterval set_difference(const SetInterval& a, const SetInterval& b) {
  return strict(a, b, [](Planes x, Planes y) { return Planes{x.lower & ~y.upper, x.upper & ~y.lower}; });
}

SetInterval set_symmetric_difference(const SetInterval& a, const SetInterval& b) {
  return strict(a, b, [](Planes x, Planes y) {
    return Planes{(x.lower & ~y.upper) | (y.lower & ~x.upper), (x.upper | y.upper) & ~(x.lower & y.lower)};
  });
}

SetInterval set_complement(const SetInterval& a) {
  return strict(a, a, [](Planes x, Planes) { return Planes{~x.upper, ~x.lower}; });
}

}  // namespace hcsp
