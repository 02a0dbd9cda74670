// SPDX-License-Identifier: Apache-2.0
// HC4 (Benhamou, Goualard, Granvilliers, Puget 1999): HC4-revise of every relation of a system until no
// domain shrinks by much, each relation again only when one of its unknowns did.
#pragma once

#include <deque>
#include <vector>

#include "solver/search/system.h"

namespace hcsp {

class Hc4 {
 public:
  explicit Hc4(const System& system);

  /// Contracts a box that every relation may have something to say of, or those of one unknown alone; false
  /// when it has no solution. PRECONDITION: the thread rounds upward.
  bool contract(std::vector<Interval>& box);
  bool contract(std::vector<Interval>& box, std::uint32_t changed);

 private:
  bool run(std::vector<Interval>& box);
  void wake(std::uint32_t relation);

  const System& system_;
  TapeRun run_;
  std::vector<Interval> told_;        // by unknown: its domain when its relations were last woken
  std::vector<std::uint32_t> queue_;  // a ring
  std::size_t first_ = 0, count_ = 0;
  std::vector<std::uint8_t> awake_;  // by relation
};

}  // namespace hcsp
