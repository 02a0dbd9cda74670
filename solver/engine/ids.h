// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace hcsp {

/// The place of a variable, or of a contractor, in its contractor graph.
using VariableId = std::uint32_t;
using ContractorId = std::uint32_t;

}  // namespace hcsp
