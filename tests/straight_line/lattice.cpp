// SPDX-License-Identifier: Apache-2.0
#include "tests/straight_line/lattice.h"

#include <algorithm>

namespace hcsp::straight_line {

Lattice::Lattice(const LatticeLimits& limits, const LatticeState& from)
    : limits_(limits), row_(static_cast<std::size_t>(2 * (limits.wh - limits.wl) + 1)) {
  ranges_.resize(row_ * static_cast<std::size_t>(limits.bh - limits.bl + 1));
  ranges_[index(from)] = {0, 0};
}

bool Lattice::is_within(const LatticeState& s, int jerk, const LatticeState& next) const {
  if (next.b < limits_.bl || next.b > limits_.bh) return false;
  const auto fits = [&](int numerator, int denominator) {  // numerator / denominator halves; denominator > 0
    return numerator >= 2 * limits_.wl * denominator && numerator <= 2 * limits_.wh * denominator;
  };
  if (!fits(next.twice_w, 1)) return false;
  if (std::int64_t{s.b} * next.b >= 0) return true;
  return jerk > 0 ? fits(s.twice_w * jerk - s.b * s.b, jerk) : fits(-s.twice_w * jerk + s.b * s.b, -jerk);
}

void Lattice::step() {
  std::vector<LatticeRange> after(ranges_.size());
  for (int b = limits_.bl; b <= limits_.bh; ++b) {
    for (int twice_w = 2 * limits_.wl; twice_w <= 2 * limits_.wh; ++twice_w) {
      const LatticeState s{twice_w, b};
      const LatticeRange& range = at(s);
      if (range.is_empty()) continue;
      for (int jerk = limits_.ul; jerk <= limits_.uh; ++jerk) {
        const LatticeState next{twice_w + 2 * b + jerk, b + jerk};
        if (!is_within(s, jerk, next)) continue;
        const std::int64_t way = 3 * twice_w + 3 * b + jerk;
        LatticeRange& there = after[index(next)];
        there.least = std::min(there.least, range.least + way);
        there.greatest = std::max(there.greatest, range.greatest + way);
      }
    }
  }
  ranges_ = std::move(after);
}

}  // namespace hcsp::straight_line
