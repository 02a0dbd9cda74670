// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "solver/contractors/inputs.h"

namespace hcsp {

/// The contractor of der(x) == f for almost every t of the context's window, a span between two instants, x
/// continuous in it: interval integration forward and backward
/// in time, gates and slices contracting each other. f(t) may be any value of its enclosure at each t, so
/// over a slice of length dt the increment of x is in [f] dt (mean value theorem for absolutely continuous
/// functions). x are some components of a tube of dimension `dim`, as many as f
/// has.
std::unique_ptr<Contractor> make_derivative_contractor(std::string name, VariableId x, std::size_t dim,
                                                       std::vector<std::size_t> components, const Dag& dag,
                                                       const std::vector<NodeId>& f,
                                                       const Inputs::Context& context);

}  // namespace hcsp
