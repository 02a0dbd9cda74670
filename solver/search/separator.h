// SPDX-License-Identifier: Apache-2.0
// Contracts boxes to the border of a set from both sides (separators: Jaulin and Desrochers, Introduction
// to the Algebra of Separators with Application to Path Planning, 2014). The outer side contracts by the
// relation, the inner side by its negation; connectives are those of formula.h, for either side.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "solver/search/point_set.h"

namespace hcsp {

class Separator {
 public:
  explicit Separator(const PointSet& set);

  /// Contracts a box of the coordinates to where the relation can be true, or false; false when it nowhere
  /// can. PRECONDITION: the thread rounds upward.
  bool contract(std::span<Interval> box, bool wanted);

 private:
  struct Side {
    Narrowing narrowing;
    /// What the relation has to be so for every value of, by unknown: any one value may be tried.
    std::vector<std::uint8_t> is_universal;
  };
  [[nodiscard]] static std::vector<std::uint8_t> universals_of(const PointSet& set, bool wanted);
  [[nodiscard]] Interval value_to_try(std::size_t unknown, int attempt) const;

  const PointSet& set_;
  std::array<Side, 2> sides_;  // by the truth that is wanted
  std::vector<Interval> extended_;
};

}  // namespace hcsp
