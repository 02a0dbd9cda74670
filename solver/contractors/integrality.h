// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "solver/engine/contractor.h"

namespace hcsp {

/// x is a whole number: the bounds of its domain are rounded inward.
std::unique_ptr<Contractor> make_integrality_contractor(std::string name, VariableId x);

}  // namespace hcsp
