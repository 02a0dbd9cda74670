// SPDX-License-Identifier: Apache-2.0
// Code in sections: what only one alternative of a choice needs is left out where the other is taken.
#pragma once

#include <set>
#include <vector>

#include "solver/online/code.h"

namespace hcsp::online {

/// What a section waits for: that a Boolean is, or may be, true; or false.
struct Guard {
  Register boolean;
  bool wanted;
  friend auto operator<=>(const Guard&, const Guard&) = default;
};

struct Section {
  std::vector<Guard> guards;  ///< all of them; those first that others wait for
  std::vector<Instruction> code;
};

/// The same code, operands before what they are of, of which other code reads the registers in `is_read`
/// only. Choices are only guards where many steps depend on them.
std::vector<Section> sections_of(std::vector<Instruction> code, const std::set<Register>& is_read);

}  // namespace hcsp::online
