// SPDX-License-Identifier: Apache-2.0
// A contractor made of a function, for tests of the engine.
#pragma once

#include <functional>
#include <memory>

#include "solver/engine/propagation.h"

namespace hcsp {

class ProbeContractor final : public Contractor {
 public:
  using Body = std::function<void(Access&)>;
  ProbeContractor(const std::string& name, Cost cost, std::vector<VariableId> reads,
                  std::vector<VariableId> writes, Body body)
      : Contractor(name, name, cost, std::move(reads), std::move(writes)), body_(std::move(body)) {}
  void contract(Access& access) override { body_(access); }

 private:
  Body body_;
};

inline ContractorId add_probe(ContractorGraph& graph, const std::string& name, Cost cost,
                              std::vector<VariableId> reads, std::vector<VariableId> writes,
                              ProbeContractor::Body body) {
  return graph.add_contractor(
      std::make_unique<ProbeContractor>(name, cost, std::move(reads), std::move(writes), std::move(body)));
}

/// Contracts an Interval variable and reports it.
inline void narrow(Access& access, VariableId v, const Interval& bound) {
  access.report<Interval>(v, contract(access.edit<Interval>(v), bound));
}

}  // namespace hcsp
