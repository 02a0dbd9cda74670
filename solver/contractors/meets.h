// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "solver/contractors/inputs.h"

namespace hcsp {

/// The contractor of "for every t, { a | c(x(t), a) } meets S": at each item, x keeps what some point a of S+
/// supports (Jaulin 2011, contractor C4). The result is exactly the hull, over the cells of S+, of HC4-revise
/// of c on the domains of x and the closure of the cell; for the Euclidean distance, in
/// which each variable occurs once, that is the hull of the solutions with a in the cell. At an item where a
/// sampled tube has no reading nothing is learnt.
std::unique_ptr<Contractor> make_meets_contractor(std::string name, std::string constraint, VariableId set,
                                                  std::size_t set_dim, const Dag& dag, NodeId relation,
                                                  const Inputs::Context& context, bool fast_paths);

}  // namespace hcsp
