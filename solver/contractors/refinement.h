// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "solver/engine/contractor.h"

namespace hcsp {

/// The contractor of "both are the same set", known on a grid and on a coarser one whose precision is a power
/// of two times as large: a cell of the coarse grid is then a block of cells of the fine one. It may meet a
/// member when some cell of the block may, and lies within every member when all cells of the block do.
std::unique_ptr<Contractor> make_refinement_contractor(std::string name, VariableId fine, VariableId coarse,
                                                       int ratio);

}  // namespace hcsp
