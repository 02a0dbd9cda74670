// SPDX-License-Identifier: Apache-2.0
// Equations that hold wherever the others do.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/search/system.h"

namespace hcsp {

/// By number among the equations: 1 where it was stated as implied, is one before it that was not once more,
/// or a linear combination of linear ones of these, in exact arithmetic: what no rounding hides.
/// PRECONDITION: the thread rounds upward.
std::vector<std::uint8_t> implied_equations(const System& system);

}  // namespace hcsp
