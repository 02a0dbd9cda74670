// SPDX-License-Identifier: Apache-2.0
// A set of points as paving sees it: those of R^dim for which a relation holds.
#pragma once

#include <span>
#include <vector>

#include "solver/contractors/formula.h"
#include "solver/search/system.h"

namespace hcsp {

struct PointSet {
  Dag& dag;
  NodeId relation;
  std::size_t dim;                        ///< the first unknowns are the coordinates
  std::vector<System::Unknown> unknowns;  ///< the others are bound by quantifiers of the relation

  [[nodiscard]] std::size_t size() const { return unknowns.size(); }
  /// The place of an input among the unknowns.
  [[nodiscard]] std::uint32_t place_of(const Input& input) const;
};

/// Contracts boxes of a set's unknowns to where a relation between them can hold.
class Narrowing {
 public:
  Narrowing(const PointSet& set, NodeId relation);

  /// False when it nowhere can. Of what a quantifier binds, the values of the box are tried and no others.
  /// PRECONDITION: the thread rounds upward.
  bool contract(std::span<Interval> box);

 private:
  const PointSet& set_;
  Program program_;
  Formula formula_;
  std::vector<std::uint32_t> places_;  // by input of the program
  std::vector<Interval> values_;
};

/// Whether a whole number follows another: beyond 2^53 doubles leave some out.
inline bool are_next(double whole, double next) { return next - whole == 1.0; }
/// The whole numbers of an interval.
Interval whole_numbers_of(const Interval& x);
/// Where an interval is cut: in the middle, or where it is unbounded, far out.
double cut_of(const Interval& x);
/// Appends the two parts of a box that is cut across one unknown, near `cut`. False where there is no number
/// between, or no two whole numbers known to be next to each other.
bool cut_across(const PointSet& set, std::span<const Interval> box, std::uint32_t unknown, double cut,
                std::vector<Interval>& parts);

}  // namespace hcsp
