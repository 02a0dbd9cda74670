// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "solver/contractors/inputs.h"

namespace hcsp {

/// The contractor of "there is an instant, of the context's window, at which c holds", c a relation
/// between reals, vectors and tubes. Reals and vectors, and tubes at given instants, keep the hull of what
/// HC4-revise leaves of them at the items where c can hold. Where that is a single gate, c holds there, and
/// contracts the tubes at the time at hand too; in a slice it would speak of one instant of it alone.
std::unique_ptr<Contractor> make_sometime_contractor(std::string name, const Dag& dag, NodeId relation,
                                                     const Inputs::Context& context);

}  // namespace hcsp
