// SPDX-License-Identifier: Apache-2.0
// Motions on a lattice, all of them: jerks that are whole numbers and change at whole instants. What they
// reach is reached; what continuous motions reach they come near to. No theory is used, so that theory can be
// tested by it.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

namespace hcsp::straight_line {

struct LatticeLimits {
  int wl, wh, bl, bh, ul, uh;
};

/// A velocity in halves, an acceleration.
struct LatticeState {
  int twice_w, b;
};

/// The least and the greatest displacement, in sixths.
struct LatticeRange {
  std::int64_t least = std::numeric_limits<std::int64_t>::max(),
               greatest = std::numeric_limits<std::int64_t>::min();
  [[nodiscard]] bool is_empty() const { return least > greatest; }
};

/// Everything that can be reached from a state within the limits, step by step.
class Lattice {
 public:
  Lattice(const LatticeLimits& limits, const LatticeState& from);
  void step();
  [[nodiscard]] const LatticeRange& at(const LatticeState& state) const { return ranges_[index(state)]; }

 private:
  [[nodiscard]] std::size_t index(const LatticeState& s) const {
    return static_cast<std::size_t>(s.b - limits_.bl) * row_ +
           static_cast<std::size_t>(s.twice_w - 2 * limits_.wl);
  }
  [[nodiscard]] bool is_within(const LatticeState& s, int jerk, const LatticeState& next) const;

  LatticeLimits limits_;
  std::size_t row_;
  std::vector<LatticeRange> ranges_;
};

}  // namespace hcsp::straight_line
