// SPDX-License-Identifier: Apache-2.0
#include "solver/contractors/sometime.h"

#include "domains/rounding.h"
#include "solver/contractors/formula.h"

namespace hcsp {

namespace {

// What is found at an item is a hull in the end: no later run comes back to it.
constexpr int kRounds = 8;

class SometimeContractor final : public Contractor {
 public:
  SometimeContractor(const std::string& name, const Program& program, Inputs inputs, Formula formula)
      : Contractor(name, name, Cost::linear, inputs.variables(), inputs.variables()),
        kinds_(kinds_of(program)),
        inputs_(std::move(inputs)),
        formula_(std::move(formula)),
        values_(kinds_.size()) {}

  void contract(Access& access) override {
    RoundUpward guard;
    inputs_.open(access);
    hull_.clear();
    possible_ = 0;
    inputs_.in_window().for_each([&](std::size_t item) { look_at(item); });
    if (possible_ == 0) return access.fail(inputs_.variables().empty() ? 0 : inputs_.blamed());
    const bool decided = possible_ == 1 && last_ % 2 == 0;
    bool alive = true;
    for (const std::uint32_t i : inputs_.contractible()) {
      if (decided || kinds_[i] != Input::Kind::tube) alive = alive && inputs_.narrow(i, last_, hull_[i]);
    }
    inputs_.report(access);
  }

 private:
  static std::vector<Input::Kind> kinds_of(const Program& program) {
    std::vector<Input::Kind> kinds;
    for (const Input& input : program.inputs()) kinds.push_back(input.kind);
    return kinds;
  }

  void look_at(std::size_t item) {
    for (std::uint32_t i = 0; i < values_.size(); ++i) values_[i] = inputs_.value(i, item);
    for (int round = 0; round < kRounds; ++round) {
      before_ = values_;
      if (!formula_.contract(values_)) return;
      if (values_ == before_) break;
    }
    if (possible_++ == 0) {
      hull_ = values_;
    } else {
      for (std::size_t i = 0; i < hull_.size(); ++i) hull_[i] = join(hull_[i], values_[i]);
    }
    last_ = item;
  }

  std::vector<Input::Kind> kinds_;  // by input
  Inputs inputs_;
  Formula formula_;
  std::vector<Interval> values_, hull_;  // by input: at an item, and at all where the relation can hold
  std::vector<Interval> before_;
  std::size_t possible_ = 0, last_ = 0;  // how many those are, and the last of them
};

}  // namespace

std::unique_ptr<Contractor> make_sometime_contractor(std::string name, const Dag& dag, NodeId relation,
                                                     const Inputs::Context& context) {
  const Program program(dag, {relation});
  Inputs inputs(program, context);
  Formula formula(dag, relation, program);
  return std::make_unique<SometimeContractor>(name, program, std::move(inputs), std::move(formula));
}

}  // namespace hcsp
