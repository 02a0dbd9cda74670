// SPDX-License-Identifier: Apache-2.0
// Whether what a result file claims is so.
#pragma once

#include <string>
#include <vector>

#include "tests/verifier/system.h"

namespace hcsp::verifier {

/// A box with its certificate: "unique", "exists", "inner" or "none".
struct Claim {
  std::string certificate;
  Place box;
};

/// The `solutions` of a result file (JSON) of a model with these unknowns. Throws std::runtime_error if it is
/// none.
std::vector<Claim> claims_of(const System& system, const std::string& json);

/// What of the claims could not be confirmed, a line each: that a box has what its certificate says, and that
/// no two unique boxes hold the same solution. Nothing is claimed by "none".
std::vector<std::string> unconfirmed(const System& system, const std::vector<Claim>& claims);

}  // namespace hcsp::verifier
