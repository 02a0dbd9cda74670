// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "solver/contractors/inputs.h"

namespace hcsp {

/// The contractor of a relation between reals, vectors and tubes: HC4-revise on its shared graph. A relation
/// that mentions the time at hand holds at every item of the context's window: it is contracted on ranges of
/// the items that changed.
std::unique_ptr<Contractor> make_relation_contractor(std::string name, const Dag& dag, NodeId relation,
                                                     const Inputs::Context& context);

}  // namespace hcsp
