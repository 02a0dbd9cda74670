// SPDX-License-Identifier: Apache-2.0
// Contractors of inclusions and operations between sets, from the arithmetic of set intervals (Jaulin 2011,
// section III-B). With complements intersection makes every operation but the symmetric difference.
#pragma once

#include <memory>
#include <string>

#include "solver/engine/contractor.h"

namespace hcsp {

/// A set, or its complement.
struct SetTerm {
  VariableId set;
  bool complemented = false;
};

/// a is a subset of b.
std::unique_ptr<Contractor> make_subset_contractor(std::string name, std::string constraint, SetTerm a,
                                                   SetTerm b);
/// whole == a inter b.
std::unique_ptr<Contractor> make_intersection_contractor(std::string name, std::string constraint,
                                                         SetTerm whole, SetTerm a, SetTerm b);
/// whole == a symdiff b.
std::unique_ptr<Contractor> make_symmetric_difference_contractor(std::string name, std::string constraint,
                                                                 SetTerm whole, SetTerm a, SetTerm b);
/// a and b have a point in common.
std::unique_ptr<Contractor> make_common_point_contractor(std::string name, std::string constraint, SetTerm a,
                                                         SetTerm b);

}  // namespace hcsp
