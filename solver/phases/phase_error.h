// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <stdexcept>
#include <string>

#include "solver/engine/ids.h"

namespace hcsp {

/// What was stated cannot be said of polynomials: by a constraint; or a tube has no definition.
class PhaseError : public std::invalid_argument {
 public:
  PhaseError(std::string of, const std::string& message)
      : std::invalid_argument(message), constraint(std::move(of)) {}
  PhaseError(VariableId undefined, const std::string& message)
      : std::invalid_argument(message), tube(undefined) {}
  std::string constraint;  ///< its name; empty of a tube
  std::optional<VariableId> tube;
};

}  // namespace hcsp
