// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "domains/set_interval.h"
#include "solver/contractors/inputs.h"

namespace hcsp {

/// The contractor of S == union over t of { a | c(x(t), a) }, c any relation of the language (with no time in
/// it: of S == { a | c(x, a) }).
///   S- gains the cells that lie in the zone of some item for every x of its domain (Jaulin 2011, contractor
///   C2); S+ keeps the cells that may lie in the zone of some item, which takes a reading at every item; x is
///   contracted, item by item, so that its zone leaves out the cells outside S+.
/// `initial` is the domain that the set begins with. At an item where a sampled tube has no reading the zone
/// says nothing.
std::unique_ptr<Contractor> make_union_contractor(std::string name, std::string constraint, VariableId set,
                                                  const SetInterval& initial, const Dag& dag, NodeId relation,
                                                  const Inputs::Context& context, bool fast_paths);

}  // namespace hcsp
