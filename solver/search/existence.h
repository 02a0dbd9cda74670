// SPDX-License-Identifier: Apache-2.0
// That a system of equations has a solution for every point of a box, by interval Newton with the point as a
// parameter.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "solver/search/membership.h"
#include "solver/search/newton.h"

namespace hcsp {

class Existence {
 public:
  /// For the equations of a relation that is bound by "for some" over `own`; null where it has none.
  static std::unique_ptr<Existence> of(const PointSet& set, NodeId relation,
                                       const std::vector<std::uint32_t>& outer,
                                       const std::vector<std::uint32_t>& own);
  Existence(const Existence&) = delete;
  Existence& operator=(const Existence&) = delete;

  /// Whether, for every value of the outer unknowns in a box, the relation is proven to hold at some value of
  /// the own ones, within their domains. `narrowing` contracts to the relation.
  bool holds(std::span<const Interval> box, Narrowing& narrowing);

 private:
  Existence(const PointSet& set, const std::vector<NodeId>& equations, std::unique_ptr<Membership::Part> rest,
            const std::vector<std::uint32_t>& outer, const std::vector<std::uint32_t>& own);
  bool lies_within(const std::vector<Interval>& enclosure) const;

  const PointSet& set_;
  std::vector<std::uint32_t> outer_, own_;
  System system_;
  MeanValueForms forms_;
  Newton newton_;
  std::unique_ptr<Membership::Part> rest_;
  std::vector<std::uint8_t> is_solved_for_;  // by unknown: an equation depends on it
  std::vector<Interval> guess_, around_;
};

}  // namespace hcsp
