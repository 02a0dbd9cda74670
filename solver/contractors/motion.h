// SPDX-License-Identifier: Apache-2.0
// How tubes move from gate to gate, as the contractors of their derivatives know it. A contractor that sweeps
// in time carries what it learns at one gate along to the next, instead of leaving that to a pass of its own.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "domains/interval/interval.h"
#include "solver/engine/ids.h"

namespace hcsp {

class Motion {
 public:
  virtual ~Motion() = default;
  /// An enclosure of x(t_{k+1}) - x(t_k) for a component of x and slice k; the whole line as long as nothing
  /// is known in this run.
  [[nodiscard]] virtual const Interval& step(std::size_t component, std::size_t slice) const = 0;
};

/// The motions of a problem's tubes; they live as long as its contractors.
using Motions = std::map<VariableId, std::vector<const Motion*>>;

}  // namespace hcsp
