// SPDX-License-Identifier: Apache-2.0
// What the terminal shows of a result.
#pragma once

#include <string>
#include <vector>

#include "solver/result.h"

namespace hcsp::tool {

/// The status, a line a shown variable (all when none is named), and why no solution exists when none does.
std::string summary(const Result& result, const std::vector<std::string>& shown);

}  // namespace hcsp::tool
