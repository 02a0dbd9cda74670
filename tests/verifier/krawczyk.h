// SPDX-License-Identifier: Apache-2.0
// Krawczyk's test (1969), with parameters where there are more unknowns than equations.
#pragma once

#include <optional>

#include "tests/verifier/system.h"

namespace hcsp::verifier {

/// As many equations as unknowns: an enclosure, in the box, of a zero that is the only one in the box, if
/// the test succeeds.
std::optional<Place> only_zero(const System& system, const Place& box);

/// Fewer equations than unknowns: whether the test shows that for every value of some unknowns in the box
/// there are values of the others in the box that make a zero.
bool has_zero_for_every(const System& system, const Place& box);

}  // namespace hcsp::verifier
