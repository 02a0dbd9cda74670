// SPDX-License-Identifier: Apache-2.0
// Equations that hold wherever the others do.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/search/system.h"

namespace hcsp {

/// By number among the equations: 1 where it is an equation before it once more, or a linear combination of
/// linear ones before it, in exact arithmetic: what no rounding hides. PRECONDITION: the thread rounds
/// upward.
std::vector<std::uint8_t> implied_equations(const System& system);

}  // namespace hcsp
