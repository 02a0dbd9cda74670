// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "solver/engine/graph.h"

namespace hcsp {

/// The contractor of "at least `least` of these hold", 1 <= least <= the number of alternatives, each a graph
/// of contractors on the variables of one problem. It is constructive: every alternative is propagated to its
/// own fixed point, and what lies in at least `least` of the results is kept. With one, a hull of the union;
/// otherwise the q-relaxed intersection of Jaulin (Set Membership Approach for Underwater Robotics, 2009).
std::unique_ptr<Contractor> make_alternatives_contractor(std::string name, std::size_t least,
                                                         std::vector<ContractorGraph> alternatives);

}  // namespace hcsp
