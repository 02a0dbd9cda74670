// SPDX-License-Identifier: Apache-2.0
#include "solver/contractors/relation.h"

#include "domains/rounding.h"
#include "solver/contractors/formula.h"
#include "solver/expression/operators.h"

namespace hcsp {

namespace {

constexpr std::size_t kLanes = 64;

class RelationContractor final : public Contractor {
 public:
  RelationContractor(const std::string& name, Program program, Inputs inputs, Formula formula)
      : Contractor(name, name, inputs.timed() ? Cost::linear : Cost::constant, inputs.variables(),
                   inputs.variables()),
        program_(std::move(program)),
        inputs_(std::move(inputs)),
        evaluation_lanes_(inputs_.timed() ? kLanes : 1),
        evaluation_(program_, evaluation_lanes_),
        items_(evaluation_lanes_),
        formula_(std::move(formula)) {}

  void contract(Access& access) override {
    RoundUpward guard;
    inputs_.open(access);
    if (formula_.has_alternatives()) return contract_by_formula(access);
    std::size_t lanes = 0;
    bool alive = true;
    inputs_.changed(access).for_each([&](std::size_t item) {
      if (!alive) return;
      inputs_.load(evaluation_, item, lanes);
      items_[lanes++] = item;
      if (lanes == evaluation_lanes_) {
        alive = contract_lanes(access, lanes);
        lanes = 0;
      }
    });
    if (alive && lanes > 0) contract_lanes(access, lanes);
    inputs_.report(access);
  }

 private:
  void contract_by_formula(Access& access) {
    bool alive = true;
    values_.resize(program_.inputs().size());
    inputs_.changed(access).for_each([&](std::size_t item) {
      if (!alive) return;
      for (std::uint32_t i = 0; i < values_.size(); ++i) values_[i] = inputs_.value(i, item);
      alive = formula_.contract(values_);
      if (!alive) access.fail(inputs_.variables().empty() ? 0 : inputs_.blamed(), inputs_.when(item));
      for (const std::uint32_t i : inputs_.contractible())
        alive = alive && inputs_.narrow(i, item, values_[i]);
    });
    inputs_.report(access);
  }

  bool contract_lanes(Access& access, std::size_t lanes) {
    evaluation_.forward(lanes);
    if (!evaluation_.backward(kTrue, 0, lanes)) {
      access.fail(inputs_.variables().empty() ? 0 : inputs_.blamed(),
                  inputs_.when(items_[evaluation_.failed_lane()]));
      return false;
    }
    bool alive = true;
    for (std::size_t lane = 0; lane < lanes; ++lane)
      alive = inputs_.store(evaluation_, items_[lane], lane) && alive;
    return alive;
  }

  Program program_;
  Inputs inputs_;
  std::size_t evaluation_lanes_;
  Evaluation evaluation_;
  std::vector<std::size_t> items_;  // by lane
  Formula formula_;
  std::vector<Interval> values_;  // of the inputs
};

}  // namespace

std::unique_ptr<Contractor> make_relation_contractor(std::string name, const Dag& dag, NodeId relation,
                                                     const Inputs::Context& context) {
  Program program(dag, {relation});
  Inputs inputs(program, context);
  Formula formula(dag, relation, program);
  return std::make_unique<RelationContractor>(name, std::move(program), std::move(inputs),
                                              std::move(formula));
}

}  // namespace hcsp
