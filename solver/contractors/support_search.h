// SPDX-License-Identifier: Apache-2.0
// The hull, over the cells of an upper bound S+, of what each cell supports of a box: a branch and bound down
// the tree. A block whose support lies within the hull so far cannot widen it and is left out; by isotonicity
// that loses nothing, so the hull is the same as over all cells, one by one. The search starts from
// witnesses, cells that supported the faces of the box before: while they still do, no face can move and
// nothing is searched.
#pragma once

#include <algorithm>
#include <vector>

#include "domains/set_descent.h"

namespace hcsp {

inline constexpr CellIndex kNoCell{INT64_MIN, INT64_MIN, INT64_MIN};

class SupportSearch {
 public:
  /// For boxes of `dim` intervals.
  explicit SupportSearch(std::size_t dim) : dim_(dim), hull_(dim), support_(dim) {}

  /// Two a dimension: the lower face of interval i is 2 i, the upper 2 i + 1.
  [[nodiscard]] std::size_t faces() const { return 2 * dim_; }

  /// feel(block, result) writes the part of `box` that some point of the block supports, or returns false.
  /// `witnesses` has a cell a face, or kNoCell, and is kept up to date; `more` are further guesses.
  template <class Feel>
  const std::vector<Interval>& run(const SetInterval& set, Feel& feel, const std::vector<Interval>& box,
                                   CellIndex* witnesses, const CellIndex* more) {
    std::fill(hull_.begin(), hull_.end(), Interval::empty());
    try_witnesses(set, feel, box, witnesses, witnesses);
    try_witnesses(set, feel, box, more, witnesses);
    for (std::size_t face = 0; face < faces(); ++face) climb(set, feel, box, face, witnesses);
    if (hull_ == box) return hull_;
    if (set.background() != CellState::outside) search_beyond(set, feel, witnesses);
    const SetInterval::Block root = set.root();
    if (!root.any_upper) return hull_;
    reserve(root.edge, set.dim());
    Interval* support = &arena_[0];
    if (feel(box_of(set, set.upper_bounds(root)), support))
      explore(set, feel, root, support, support + dim_, witnesses);
    return hull_;
  }

  /// Every face has a witness, and it is still a cell of S+.
  [[nodiscard]] bool all_stand(const SetInterval& set, const CellIndex* witnesses) const {
    return std::all_of(witnesses, witnesses + faces(),
                       [&](const CellIndex& cell) { return cell != kNoCell && may_hold(set.at_cell(cell)); });
  }

  /// No cell supported anything.
  [[nodiscard]] bool found_none() const { return dim_ > 0 && hull_[0].is_empty(); }

 private:
  static bool may_hold(CellState state) { return state == CellState::unknown || state == CellState::inside; }

  // The closure of a box of cells.
  static std::array<Interval, 3> box_of(const SetInterval& set, const Region& cells) {
    std::array<Interval, 3> box;
    for (std::size_t axis = 0; axis < set.dim(); ++axis) {
      box[axis] = Interval::raw(set.grid().line(cells.lo[axis]), set.grid().line(cells.hi[axis]));
    }
    return box;
  }

  [[nodiscard]] bool widens(const Interval* support) const {
    for (std::size_t i = 0; i < dim_; ++i) {
      if (!leq(support[i], hull_[i])) return true;
    }
    return false;
  }

  // How far a support reaches beyond the hull: the order in which to look at blocks. It changes no result.
  // Bounds may be infinite, so only faces that do reach further are measured.
  [[nodiscard]] double reach(const Interval* support) const {
    double reach = 0.0;
    for (std::size_t i = 0; i < dim_; ++i) {
      if (support[i].lo() < hull_[i].lo()) reach += std::min(hull_[i].lo() - support[i].lo(), 1e100);
      if (support[i].hi() > hull_[i].hi()) reach += std::min(support[i].hi() - hull_[i].hi(), 1e100);
    }
    return reach;
  }

  void widen(const Interval* support, const CellIndex& cell, CellIndex* witnesses) {
    for (std::size_t i = 0; i < dim_; ++i) {
      if (support[i].lo() < hull_[i].lo()) witnesses[2 * i] = cell;
      if (support[i].hi() > hull_[i].hi()) witnesses[2 * i + 1] = cell;
      hull_[i] = join(hull_[i], support[i]);
    }
  }

  [[nodiscard]] bool is_supported(const std::vector<Interval>& box, std::size_t face) const {
    const Interval& known = hull_[face / 2];
    return face % 2 == 0 ? known.lo() <= box[face / 2].lo() : known.hi() >= box[face / 2].hi();
  }

  // Widens the hull by what a cell supports, if it is a cell of S+.
  template <class Feel>
  void try_cell(const SetInterval& set, Feel& feel, const CellIndex& cell, CellIndex* witnesses) {
    if (!may_hold(set.at_cell(cell))) return;
    if (feel(box_of(set, Region::block(cell, 1, set.dim())), support_.data()))
      widen(support_.data(), cell, witnesses);
  }

  template <class Feel>
  void try_witnesses(const SetInterval& set, Feel& feel, const std::vector<Interval>& box,
                     const CellIndex* guesses, CellIndex* witnesses) {
    for (std::size_t face = 0; face < faces(); ++face) {
      const CellIndex cell = guesses[face];
      if (cell != kNoCell && !is_supported(box, face)) try_cell(set, feel, cell, witnesses);
    }
  }

  // A face that has lost its witness is mostly supported by a cell close by: steps to better neighbours while
  // there are.
  template <class Feel>
  void climb(const SetInterval& set, Feel& feel, const std::vector<Interval>& box, std::size_t face,
             CellIndex* witnesses) {
    constexpr int kSteps = 4;
    for (int step = 0; step < kSteps && !is_supported(box, face); ++step) {
      const CellIndex center = witnesses[face];
      if (center == kNoCell) return;
      for (int neighbour = 0; neighbour < (set.dim() == 1 ? 3 : (set.dim() == 2 ? 9 : 27)); ++neighbour) {
        CellIndex cell = center;
        int digits = neighbour;
        for (std::size_t axis = 0; axis < set.dim(); ++axis, digits /= 3) cell[axis] += digits % 3 - 1;
        if (cell != center) try_cell(set, feel, cell, witnesses);
        if (is_supported(box, face)) return;
      }
      if (witnesses[face] == center) return;
    }
  }

  // The space beyond the tree, as the half-spaces around the root.
  template <class Feel>
  void search_beyond(const SetInterval& set, Feel& feel, CellIndex* witnesses) {
    const std::array<Interval, 3> root = box_of(set, set.reach());
    for (std::size_t axis = 0; axis < set.dim(); ++axis) {
      for (const bool above : {false, true}) {
        std::array<Interval, 3> half;
        half[axis] =
            above ? Interval::raw(root[axis].hi(), kInfinity) : Interval::raw(-kInfinity, root[axis].lo());
        if (feel(half, support_.data())) widen(support_.data(), kNoCell, witnesses);  // no cell to witness it
      }
    }
  }

  // Room for the supports of a block's parts at every depth: nothing is allocated in the search.
  void reserve(std::int64_t edge, std::size_t set_dim) {
    std::size_t depth = 1;
    for (; edge > 1; edge /= 2) ++depth;
    arena_.resize(std::max(arena_.size(), dim_ * (1 + depth * (std::size_t{1} << set_dim))));
  }

  // `support` is what the block supports; `free` is the arena from here on.
  template <class Feel>
  void explore(const SetInterval& set, Feel& feel, const SetInterval::Block& block, const Interval* support,
               Interval* free, CellIndex* witnesses) {
    if (!widens(support)) return;
    if (block.edge == 1) return widen(support, block.lo, witnesses);
    std::array<SetInterval::Block, 8> parts;
    std::array<double, 8> reaches{};
    std::size_t count = 0;
    set.for_each_upper_part(block, [&](const SetInterval::Block& part) {
      Interval* of_part = free + count * dim_;
      if (!feel(box_of(set, set.upper_bounds(part)), of_part) || !widens(of_part)) return;
      reaches[count] = reach(of_part);
      parts[count++] = part;
    });
    std::array<bool, 8> done{};
    for (std::size_t left = count; left > 0;
         --left) {  // the part that reaches furthest first; every part in the end
      std::size_t best = count;
      for (std::size_t i = 0; i < count; ++i) {
        if (!done[i] && (best == count || reaches[i] > reaches[best])) best = i;
      }
      done[best] = true;
      explore(set, feel, parts[best], free + best * dim_, free + count * dim_, witnesses);
    }
  }

  std::size_t dim_;
  std::vector<Interval> hull_, support_, arena_;
};

}  // namespace hcsp
