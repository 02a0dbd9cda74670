// SPDX-License-Identifier: Apache-2.0
#include "solver/support.h"

#include <algorithm>

namespace hcsp {

namespace {

using Parts = std::vector<std::size_t>;

Parts joined(Parts a, const Parts& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

struct Search {
  const InfeasibleWith& infeasible;
  const std::function<bool()>& stop;

  // A minimal part of `candidates` that conflicts together with `background`; `grown` says that the
  // background has gained parts since it was last known to be free of conflict.
  [[nodiscard]] Parts explain(const Parts& background, bool grown, const Parts& candidates) const {
    if (stop()) return candidates;
    if (grown && infeasible(background)) return {};
    if (candidates.size() == 1) return candidates;
    const auto middle = candidates.begin() + static_cast<std::ptrdiff_t>(candidates.size() / 2);
    const Parts first(candidates.begin(), middle), second(middle, candidates.end());
    const Parts from_second = explain(joined(background, first), true, second);
    const Parts from_first = explain(joined(background, from_second), !from_second.empty(), first);
    return joined(from_first, from_second);
  }
};

}  // namespace

std::vector<std::size_t> minimal_conflict(const std::vector<std::size_t>& preferred,
                                          const InfeasibleWith& infeasible,
                                          const std::function<bool()>& stop) {
  if (preferred.empty()) return {};
  Parts conflict = Search{infeasible, stop}.explain({}, true, preferred);
  std::sort(conflict.begin(), conflict.end());
  return conflict;
}

}  // namespace hcsp
