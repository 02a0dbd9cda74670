// SPDX-License-Identifier: Apache-2.0
#include "solver/contractors/alternatives.h"

#include <algorithm>
#include <map>

#include "solver/contractors/in_at_least.h"
#include "solver/engine/propagation.h"

namespace hcsp {

namespace {

// A domain of any lattice as a value, for in_at_least().
struct AnyDomain {
  std::shared_ptr<const Slot> slot;
};

AnyDomain meet(const AnyDomain& a, const AnyDomain& b) {
  std::unique_ptr<Slot> both = a.slot->clone();
  both->meet_with(*b.slot);
  return {std::move(both)};
}

AnyDomain join(const AnyDomain& a, const AnyDomain& b) {
  std::unique_ptr<Slot> hull = a.slot->clone();
  hull->join_with(*b.slot);
  return {std::move(hull)};
}

std::vector<VariableId> variables_of(const ContractorGraph& graph) {
  std::vector<VariableId> variables;
  for (VariableId v = 0; v < graph.variables().size(); ++v) {
    if (graph.variable(v).present()) variables.push_back(v);
  }
  return variables;
}

std::vector<VariableId> variables_of(const std::vector<ContractorGraph>& graphs) {
  std::vector<VariableId> variables;
  for (const ContractorGraph& graph : graphs) {
    const std::vector<VariableId> more = variables_of(graph);
    variables.insert(variables.end(), more.begin(), more.end());
  }
  std::sort(variables.begin(), variables.end());
  variables.erase(std::unique(variables.begin(), variables.end()), variables.end());
  return variables;
}

class AlternativesContractor final : public Contractor {
 public:
  AlternativesContractor(const std::string& name, std::size_t least,
                         std::vector<ContractorGraph> alternatives)
      : Contractor(name, name, Cost::search, variables_of(alternatives), variables_of(alternatives)),
        least_(least),
        alternatives_(std::move(alternatives)) {
    for (const ContractorGraph& alternative : alternatives_) joined_.push_back(variables_of(alternative));
  }

  void contract(Access& access) override {
    std::vector<std::map<VariableId, AnyDomain>> possible;
    for (std::size_t k = 0; k < alternatives_.size(); ++k) {
      Propagation run(alternatives_[k], access.limits());
      for (const VariableId v : joined_[k]) run.set_domain(v, access.slot(v));
      if (run.run() == Ending::empty) continue;
      auto& domains = possible.emplace_back();
      for (const VariableId v : joined_[k]) domains[v] = {run.slot(v).clone()};
    }
    if (possible.size() < least_) return access.fail(reads().empty() ? 0 : reads().front());
    for (const VariableId v : writes()) keep(access, v, possible);
  }

 private:
  // An alternative that does not speak of a variable leaves it as it is.
  void keep(Access& access, VariableId v, const std::vector<std::map<VariableId, AnyDomain>>& possible) {
    std::vector<AnyDomain> domains;
    for (const auto& alternative : possible) {
      const auto found = alternative.find(v);
      domains.push_back(found != alternative.end() ? found->second : AnyDomain{access.slot(v).clone()});
    }
    access.narrow(v, *in_at_least(least_, domains).slot);
  }

  std::size_t least_;
  std::vector<ContractorGraph> alternatives_;
  std::vector<std::vector<VariableId>> joined_;  // by alternative
};

}  // namespace

std::unique_ptr<Contractor> make_alternatives_contractor(std::string name, std::size_t least,
                                                         std::vector<ContractorGraph> alternatives) {
  return std::make_unique<AlternativesContractor>(name, least, std::move(alternatives));
}

}  // namespace hcsp
