// SPDX-License-Identifier: Apache-2.0
#include "solver/search/choices.h"

#include <algorithm>
#include <cmath>

#include "solver/expression/operators.h"

namespace hcsp {

Choices::Choices(const System& system) : system_(system) {
  for (const System::Choice& choice : system.choices)
    all_.push_back(
        {&choice, Formula(system.dag, choice.relation, choice.program), Evaluation(choice.program)});
}

bool Choices::contract(std::vector<Interval>& box) {
  for (One& one : all_) {
    const std::vector<std::uint32_t>& unknowns = one.choice->unknowns;
    values_.clear();
    for (const std::uint32_t v : unknowns) values_.push_back(box[v]);
    if (!one.formula.contract(values_)) return false;
    for (std::size_t i = 0; i < unknowns.size(); ++i) box[unknowns[i]] = meet(box[unknowns[i]], values_[i]);
  }
  for (std::size_t v = 0; v < box.size(); ++v) {
    if (system_.is_whole[v] != 0 && !shrink_to_whole(box[v])) return false;
  }
  return true;
}

bool Choices::shrink_to_whole(Interval& domain) {
  domain = Interval::raw(std::ceil(domain.lo()), std::floor(domain.hi()));
  return !domain.is_empty();
}

bool Choices::all_hold(const std::vector<Interval>& box) {
  return std::all_of(all_.begin(), all_.end(), [&](One& one) {
    if (one.choice->is_implied) return true;
    for (std::uint32_t i = 0; i < one.choice->unknowns.size(); ++i)
      one.evaluation.set(i, box[one.choice->unknowns[i]]);
    one.evaluation.forward();
    return one.evaluation.get(one.choice->program.root()) == kTrue;
  });
}

}  // namespace hcsp
