// SPDX-License-Identifier: Apache-2.0
// Set intervals [A-, A+] of R^n (Jaulin 2011, section III-B): all sets between a lower and an upper bound,
// each a union of grid cells. Two bits a cell: `lower`, the cell lies within every member; `upper`, the cell
// may meet a member. Cells stand in tiles of 64 (8 x 8, 4 x 4 x 4, 64 in a row), tiles in a sparse tree of
// fan-out 64 whose uniform regions cost one bit pair; beyond the tree the background holds, so the world has
// no border.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "domains/box.h"
#include "domains/grid.h"

namespace hcsp {

/// The four states of a cell, as (lower, upper).
enum class CellState : std::uint8_t { outside, unknown, inside, contradiction };

/// 64 cells at a time: one bit of each plane a cell.
struct Planes {
  std::uint64_t lower = 0;
  std::uint64_t upper = 0;
  friend bool operator==(const Planes&, const Planes&) = default;
};

/// A region of space as a box of cells, lo <= index < hi on every axis: the Delta of a set interval.
struct Region {
  CellIndex lo{};
  CellIndex hi{};
  bool beyond = false;  ///< also the space beyond the tree

  [[nodiscard]] bool has_cells() const { return lo[0] < hi[0]; }
  [[nodiscard]] bool is_none() const { return !has_cells() && !beyond; }
  void join(const Region& other);
  [[nodiscard]] bool meets(const Region& other, std::size_t dim) const;
  [[nodiscard]] bool holds(const Region& other, std::size_t dim) const;
  /// The cells that are in both; the regions meet.
  [[nodiscard]] Region common(const Region& other, std::size_t dim) const;
  /// The cubic block of edge^dim cells from lo.
  [[nodiscard]] static Region block(const CellIndex& lo, std::int64_t edge, std::size_t dim);
};

class SetInterval {
 public:
  using Delta = Region;

  /// Every subset of R^dim, on cells of edge `precision`. With a frame, every subset of the cells that the
  /// closed frame touches: beyond is outside. Throws std::invalid_argument on a bad dimension, precision, or
  /// a frame that is empty, flat in an axis, or beyond the addressable cells.
  SetInterval(std::size_t dim, double precision, const std::optional<Box>& frame = {});

  [[nodiscard]] const Grid& grid() const { return grid_; }
  [[nodiscard]] std::size_t dim() const { return grid_.dim(); }
  [[nodiscard]] double precision() const { return grid_.precision(); }
  [[nodiscard]] bool is_empty() const { return empty_; }
  /// The state of all space that the tree does not cover.
  [[nodiscard]] CellState background() const;
  /// The state of the cell that holds a point; `point` has dim coordinates.
  [[nodiscard]] CellState at(const double* point) const;
  /// The state of a cell.
  [[nodiscard]] CellState at_cell(const CellIndex& cell) const;

  /// Whether any of space is outside every member.
  [[nodiscard]] bool has_outside() const;

  /// Boxes [lo1, hi1, lo2, hi2, ...] that tile the cells of a state, merged where they touch, as far as the
  /// tree reaches.
  [[nodiscard]] std::vector<std::vector<double>> boxes(CellState state) const;
  /// The same as boxes of cell indices.
  [[nodiscard]] std::vector<Region> cells(CellState state) const;
  /// Bounds of the volume of every member: of A- rounded down, of A+ rounded up (oo when the background is
  /// unknown).
  [[nodiscard]] double lower_volume() const;
  [[nodiscard]] double upper_volume() const;

  // The tree, for contractors that descend it.

  /// Grows the tree until it covers some cells, as far as they are addressable. The set stays the same.
  void cover(const Region& cells);

  /// A cubic block of cells: the root, or a part of one, and a summary of its cells.
  struct Block {
    CellIndex lo{};          ///< its first cell
    std::int64_t edge = 0;   ///< cells along an edge, a power of two
    std::uint32_t node = 0;  ///< the node that holds it, or kNoNode within a uniform block
    CellIndex node_lo{};     ///< and its first cell
    std::uint64_t mask = 0;  ///< its children in that node
    std::int64_t child_edge = 0;
    bool any_upper = false;  ///< some cell is in A+
    bool all_lower = false;  ///< every cell is in A-
    bool all_upper = false;  ///< every cell is in A+; false may also mean that it takes a closer look
  };
  static constexpr std::uint32_t kNoNode = 0xffffffffU;

  [[nodiscard]] Block root() const;
  /// Half of a block along every axis: bit k of `corner` chooses along axis k. Not for a single cell.
  [[nodiscard]] Block part(const Block& block, int corner) const;
  /// Calls visit(part) for the parts that meet A+.
  template <class Visit>
  void for_each_upper_part(const Block& block, Visit visit) const;
  /// A box of cells within the block that has all its cells of A+. PRECONDITION: block.any_upper.
  [[nodiscard]] Region upper_bounds(const Block& block) const;

  /// Decides, block by block, which cells of `bounds` lie within every member: see set_descent.h.
  template <class Zone>
  Region include(const Region& bounds, Zone& zone);
  /// Decides, block by block, which cells of `bounds` meet no member.
  template <class Zone>
  Region exclude(const Region& bounds, Zone& zone);
  /// Removes all space beyond the tree from A+.
  Region exclude_background();

  /// target := op(target, source), cell by cell. `where` bounds the cells where that can change anything; the
  /// Region of the change comes back. Grids must agree: std::invalid_argument otherwise. Neither set may be
  /// empty.
  using WordOperation = Planes (*)(Planes target, Planes source);
  friend Region combine(SetInterval& target, const SetInterval& source, WordOperation op,
                        const Region& where);
  /// The cells that the tree covers.
  [[nodiscard]] Region reach() const;
  /// The whole of space: every cell and what lies beyond.
  [[nodiscard]] static Region everywhere();

 private:
  // A child is uniform (its two bits are the state of all its cells) or mixed: then it has a node, `lower`
  // says that all its cells are inside and `upper` that some cell may hold members. Kept canonical: no mixed
  // child is uniform.
  struct Node {
    std::uint64_t lower = 0, upper = 0, mixed = 0;
    std::uint32_t children = kNoNode;
  };
  using Children = std::array<std::uint32_t, 64>;
  struct OutsideOf;
  struct View;  // a node of another tree, or a uniform region of it
  friend SetInterval bottom(const SetInterval& a);

  [[nodiscard]] int axis_bits() const { return 6 / static_cast<int>(grid_.dim()); }
  [[nodiscard]] std::int64_t side() const { return std::int64_t{1} << axis_bits(); }
  [[nodiscard]] std::int64_t root_edge() const { return std::int64_t{1} << (axis_bits() * levels_); }
  void place_root();
  [[nodiscard]] std::uint64_t part_mask(std::int64_t part, int bit) const;
  [[nodiscard]] CellIndex child_place(const CellIndex& origin, std::int64_t child_edge, int bit) const;
  [[nodiscard]] int part_bit(std::int64_t part, int corner) const;
  [[nodiscard]] std::uint64_t children_within(const Region& bounds, const CellIndex& origin,
                                              std::int64_t child_edge, bool wholly) const;
  [[nodiscard]] Region bounds_of(std::uint64_t children, const CellIndex& origin,
                                 std::int64_t child_edge) const;
  [[nodiscard]] std::uint64_t mask_of_part(const Block& block, int corner) const;
  [[nodiscard]] Block part(const Block& block, int corner, std::uint64_t mask) const;
  void sum_up(Block& block) const;
  void collect_runs(std::uint32_t node, std::int64_t child_edge, const CellIndex& origin, CellState state,
                    std::vector<Region>& runs) const;
  [[nodiscard]] double volume_of(const std::vector<Region>& cells, bool upward) const;

  std::uint32_t new_node(Planes uniform);
  std::uint32_t child(std::uint32_t node, int bit);
  void free_node(std::uint32_t node);
  void refresh(std::uint32_t node, int bit);
  void grow_to(int levels);
  [[nodiscard]] bool has_cell(std::uint32_t node, std::uint64_t mask, CellState state) const;
  void combine_node(std::uint32_t node, const View& source, std::int64_t child_edge, const CellIndex& origin,
                    WordOperation op, const Region& where, Region& delta);

  template <bool kInclude, class Zone>
  void descend(std::uint32_t node, std::int64_t child_edge, const CellIndex& origin, std::int64_t part,
               int bit, const Region& bounds, Zone& zone, Region& delta);
  template <bool kInclude, class Zone>
  void descend_node(std::uint32_t node, std::int64_t child_edge, const CellIndex& origin,
                    const Region& bounds, Zone& zone, Region& delta);
  template <bool kInclude, class Zone>
  Region decide(const Region& bounds, Zone& zone);
  template <bool kInclude>
  void settle(std::uint32_t node, std::uint64_t mask);

  Grid grid_;
  bool empty_ = false;
  Planes background_;  // words of equal bits
  std::uint32_t root_ = 0;
  CellIndex origin_{};  // the root's first cell
  int levels_ = 1;      // of the tree; the root's children have edge side^(levels - 1)
  std::vector<Node> nodes_;
  std::vector<Children> children_;
  std::vector<std::uint32_t> free_nodes_;
};

// The lattice, cell by cell. Grids must agree: std::invalid_argument otherwise.
SetInterval meet(const SetInterval& a, const SetInterval& b);
SetInterval join(const SetInterval& a, const SetInterval& b);
bool leq(const SetInterval& a, const SetInterval& b);
bool operator==(const SetInterval& a, const SetInterval& b);
SetInterval top(const SetInterval& a);
SetInterval bottom(const SetInterval& a);
Region contract(SetInterval& a, const SetInterval& b);
inline Region everything(const SetInterval&) { return SetInterval::everywhere(); }
/// The volume that is left open, A+ without A-; oo where the background is unknown.
double measure(const SetInterval& a);

// The arithmetic of set intervals (the paper's Fig. 5): [A] op [B] is the least set interval that holds A op
// B for all A of [A] and B of [B]. Exact, since cells partition space.
SetInterval set_union(const SetInterval& a, const SetInterval& b);
SetInterval set_intersection(const SetInterval& a, const SetInterval& b);
SetInterval set_difference(const SetInterval& a, const SetInterval& b);
SetInterval set_symmetric_difference(const SetInterval& a, const SetInterval& b);
SetInterval set_complement(const SetInterval& a);

static_assert(Lattice<SetInterval>);

}  // namespace hcsp
