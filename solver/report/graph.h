// SPDX-License-Identifier: Apache-2.0
// The constraint diagram (Jaulin 2011, Fig. 6): variables and contractors, and who reads and contracts what.
#pragma once

#include <string>

namespace hcsp {

class ContractorGraph;

/// The diagram in the language of Graphviz.
std::string to_dot(const ContractorGraph& graph);
/// The diagram as a picture.
std::string graph_svg(const ContractorGraph& graph);

}  // namespace hcsp
