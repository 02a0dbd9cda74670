// SPDX-License-Identifier: Apache-2.0
#include "solver/contractors/disjoint.h"

#include "domains/set_interval.h"
#include "solver/engine/propagation.h"

namespace hcsp {

namespace {

Planes without(Planes target, Planes source) { return {target.lower, target.upper & ~source.lower}; }

class DisjointContractor final : public Contractor {
 public:
  DisjointContractor(std::string name, std::string constraint, VariableId a, VariableId b)
      : Contractor(std::move(name), std::move(constraint), Cost::linear, {a, b}, {a, b}), a_(a), b_(b) {}

  void contract(Access& access) override {
    remove(access, a_, b_);
    if (!access.domain<SetInterval>(b_).is_empty()) remove(access, b_, a_);
    access.settled();  // A- and B- do not change, and they alone decide
  }

 private:
  // What became certain in `source` since the last run is not in `target`.
  static void remove(Access& access, VariableId source, VariableId target) {
    const Region& changed = access.delta<SetInterval>(source);
    if (changed.is_none()) return;
    SetInterval& set = access.edit<SetInterval>(target);
    access.report<SetInterval>(target, combine(set, access.domain<SetInterval>(source), without, changed));
  }

  VariableId a_, b_;
};

}  // namespace

std::unique_ptr<Contractor> make_disjoint_contractor(std::string name, std::string constraint, VariableId a,
                                                     VariableId b) {
  return std::make_unique<DisjointContractor>(std::move(name), std::move(constraint), a, b);
}

}  // namespace hcsp
