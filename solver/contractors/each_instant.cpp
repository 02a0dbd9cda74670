// SPDX-License-Identifier: Apache-2.0
#include "solver/contractors/each_instant.h"

#include <algorithm>

#include "domains/tube.h"
#include "solver/engine/propagation.h"

namespace hcsp {

namespace {

std::vector<VariableId> shared_by_instants(const ContractorGraph& graph, const std::set<VariableId>& own) {
  std::vector<VariableId> shared;
  for (VariableId v = 0; v < graph.variables().size(); ++v) {
    if (graph.variable(v).present() && !own.contains(v)) shared.push_back(v);
  }
  return shared;
}

class EachInstantContractor final : public Contractor {
 public:
  EachInstantContractor(const std::string& name, ContractorGraph contractors, const InstantAtHand& instant,
                        std::shared_ptr<const TimeLine> line, const ItemSet& window)
      : Contractor(name, name, Cost::search, shared_by_instants(contractors, instant.own),
                   shared_by_instants(contractors, instant.own)),
        contractors_(std::move(contractors)),
        at_hand_(instant.item),
        line_(std::move(line)),
        window_(window) {
    for (const VariableId v : reads()) {
      const auto* tube = dynamic_cast<const TypedSlot<Tube>*>(&contractors_.variable(v).initial());
      (tube != nullptr && !instant.anchored.contains(v) ? pointwise_ : others_).push_back(v);
    }
  }

  void contract(Access& access) override {
    bool alive = true;
    changed(access).for_each([&](std::size_t item) {
      if (alive && !access.should_stop()) alive = contract_at(access, item);
    });
  }

 private:
  // The items at which what the contractors see has changed since the last run.
  [[nodiscard]] ItemSet changed(const Access& access) const {
    const bool everywhere = reads().empty() || std::any_of(others_.begin(), others_.end(),
                                                           [&](VariableId v) { return access.changed(v); });
    if (everywhere) return window_;
    ItemSet items;
    for (const VariableId v : pointwise_) items.join(access.delta<Tube>(v));
    items.meet(window_);
    return items;
  }

  bool contract_at(Access& access, std::size_t item) {
    *at_hand_ = ItemSet::range(item, item);
    Propagation run(contractors_, access.limits());
    for (const VariableId v : reads()) run.set_domain(v, access.slot(v));
    if (run.run() == Ending::empty) {
      const Interval span = line_->span(item);
      access.fail(reads().empty() ? 0 : reads().front(), std::array{span.lo(), span.hi()});
      return false;
    }
    for (const VariableId v : writes()) access.narrow(v, run.slot(v));
    return true;
  }

  ContractorGraph contractors_;
  std::shared_ptr<ItemSet> at_hand_;
  std::shared_ptr<const TimeLine> line_;
  ItemSet window_;
  std::vector<VariableId> pointwise_, others_;  // of those read: tubes at the time at hand, and the rest
};

}  // namespace

std::unique_ptr<Contractor> make_each_instant_contractor(std::string name, ContractorGraph contractors,
                                                         const InstantAtHand& instant,
                                                         std::shared_ptr<const TimeLine> line,
                                                         const ItemSet& window) {
  return std::make_unique<EachInstantContractor>(name, std::move(contractors), instant, std::move(line),
                                                 window);
}

}  // namespace hcsp
