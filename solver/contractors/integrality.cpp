// SPDX-License-Identifier: Apache-2.0
#include "solver/contractors/integrality.h"

#include <cmath>

#include "domains/interval/interval.h"
#include "domains/rounding.h"
#include "solver/engine/propagation.h"

namespace hcsp {

namespace {

class IntegralityContractor final : public Contractor {
 public:
  IntegralityContractor(const std::string& name, VariableId x)
      : Contractor(name, name, Cost::constant, {x}, {x}), x_(x) {}

  void contract(Access& access) override {
    RoundUpward guard;
    auto& x = access.edit<Interval>(x_);
    const double lo = std::ceil(x.lo()), hi = std::floor(x.hi());
    access.report<Interval>(x_, hcsp::contract(x, lo <= hi ? Interval::raw(lo, hi) : Interval::empty()));
    access.settled();
  }

 private:
  VariableId x_;
};

}  // namespace

std::unique_ptr<Contractor> make_integrality_contractor(std::string name, VariableId x) {
  return std::make_unique<IntegralityContractor>(std::move(name), x);
}

}  // namespace hcsp
