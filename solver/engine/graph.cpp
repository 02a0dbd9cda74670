// SPDX-License-Identifier: Apache-2.0
#include "solver/engine/graph.h"

namespace hcsp {

VariableId ContractorGraph::add_slot(const std::string& name, bool hidden, std::unique_ptr<Slot> slot) {
  require(names_.insert(name).second, "ContractorGraph: there is a variable {} already", name);
  variables_.emplace_back(name, hidden, std::move(slot));
  return static_cast<VariableId>(variables_.size() - 1);
}

ContractorId ContractorGraph::add_contractor(std::unique_ptr<Contractor> contractor) {
  for (const std::span<const VariableId> variables : {contractor->reads(), contractor->writes()}) {
    for (const VariableId v : variables) {
      require(v < variables_.size(), "ContractorGraph: contractor {} joins an unknown variable",
              contractor->name());
    }
  }
  const auto id = static_cast<ContractorId>(contractors_.size());
  for (const VariableId v : contractor->reads()) variables_[v].readers_.push_back(id);
  contractors_.push_back(std::move(contractor));
  return id;
}

ContractorGraph ContractorGraph::part(std::vector<std::unique_ptr<Contractor>> contractors) const {
  ContractorGraph graph;
  for (const Variable& variable : variables_) graph.variables_.emplace_back(variable.name_, true, nullptr);
  for (auto& contractor : contractors) {
    for (const std::span<const VariableId> joined : {contractor->reads(), contractor->writes()}) {
      for (const VariableId v : joined) {
        if (!graph.variables_[v].present()) graph.variables_[v].initial_ = variables_[v].initial().clone();
      }
    }
    graph.add_contractor(std::move(contractor));
  }
  return graph;
}

}  // namespace hcsp
