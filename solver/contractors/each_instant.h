// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <set>
#include <string>

#include "domains/time_line.h"
#include "solver/engine/graph.h"

namespace hcsp {

/// What contractors that hold at each instant by itself have in common.
struct InstantAtHand {
  std::shared_ptr<ItemSet> item = std::make_shared<ItemSet>();  ///< the window of all of them
  std::set<VariableId> own;                                     ///< unknowns that are others at each instant
  std::set<VariableId> anchored;                                ///< tubes that are taken at given instants
};

/// The contractor of "at each instant of the window, all of these hold": at every item, the contractors,
/// whose window is `instant.item`, are propagated to their fixed point, and what is left of the unknowns that
/// the instants share is kept. In an open slice the contractors speak of one instant of it, any one: nothing
/// that they conclude may rest on two. So they keep to the item, and to constants.
std::unique_ptr<Contractor> make_each_instant_contractor(std::string name, ContractorGraph contractors,
                                                         const InstantAtHand& instant,
                                                         std::shared_ptr<const TimeLine> line,
                                                         const ItemSet& window);

}  // namespace hcsp
