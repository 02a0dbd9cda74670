// SPDX-License-Identifier: Apache-2.0
// The q-relaxed intersection in any lattice.
#pragma once

#include <algorithm>
#include <vector>

namespace hcsp {

/// What lies in at least `count` of some elements of a lattice, 1 <= count <= size: the join over all choices
/// of `count` of their meets, in that many times size operations (the q-relaxed intersection of Jaulin, Set
/// Membership Approach for Underwater Robotics, 2009, with q = size - count).
template <class D>
D in_at_least(std::size_t count, const std::vector<D>& elements) {
  std::vector<D> kept;  // what lies in at least 1, 2, ... of the elements so far
  for (const D& element : elements) {
    if (kept.size() < count) kept.push_back(kept.empty() ? element : meet(kept.back(), element));
    const std::size_t known = std::min(kept.size(), static_cast<std::size_t>(&element - elements.data()));
    for (std::size_t j = known; j-- > 0;)
      kept[j] = join(kept[j], j == 0 ? element : meet(kept[j - 1], element));
  }
  return kept.back();
}

}  // namespace hcsp
