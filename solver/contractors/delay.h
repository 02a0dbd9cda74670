// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "domains/time_line.h"
#include "solver/engine/contractor.h"

namespace hcsp {

/// The contractor of y(t) == x(t - delay) for every t at which t - delay is on the time line; a negative
/// delay looks ahead. Instants are doubles by definition: an instant of the line that the delay moves to
/// within 4 units in the last place of another is moved to that one.
std::unique_ptr<Contractor> make_delay_contractor(std::string name, VariableId y, VariableId x,
                                                  const TimeLine& line, double delay);

}  // namespace hcsp
