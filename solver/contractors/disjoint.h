// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "solver/engine/contractor.h"

namespace hcsp {

/// The contractor of A n B = {}: A+ loses B-, B+ loses A-, cell by cell where the other changed (Jaulin 2011,
/// section IV).
std::unique_ptr<Contractor> make_disjoint_contractor(std::string name, std::string constraint, VariableId a,
                                                     VariableId b);

}  // namespace hcsp
