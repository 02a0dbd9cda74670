// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "domains/time_line.h"
#include "solver/engine/contractor.h"

namespace hcsp {

/// The contractor of y(t) == x(t - delay) for every t at which t - delay is on the time line; a negative
/// delay looks ahead. Instants are doubles by definition, and so is t - delay: where it comes within 4 units
/// in the last place of an instant of the line, it is that instant.
std::unique_ptr<Contractor> make_delay_contractor(std::string name, VariableId y, VariableId x,
                                                  const TimeLine& line, double delay);

}  // namespace hcsp
