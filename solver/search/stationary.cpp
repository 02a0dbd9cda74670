// SPDX-License-Identifier: Apache-2.0
#include "solver/search/stationary.h"

#include <algorithm>
#include <functional>

#include "domains/interval/kernel.h"

namespace hcsp {

Stationary::Stationary(const Minimisation& problem)
    : problem_(problem),
      run_(*problem.with_value.tape),
      gradient_run_(*problem.gradient->tape),
      choices_(problem.constraints),
      forms_(*problem.gradient),
      newton_(*problem.gradient, forms_),
      slopes_(problem.with_value.size()) {}

bool Stationary::contract(std::vector<Interval>& box) {
  point_.assign(box.begin(), box.end() - 1);
  if (!is_bounded(point_) || !find_free(point_) || !is_inside()) return true;
  constexpr int kMostSteps = 10;
  for (int k = 0; k < kMostSteps; ++k) {
    gradient_run_.start(point_);
    for (const std::uint32_t row : rows_) {
      if (!gradient_run_.revise(row, Interval::raw(0.0, 0.0))) return false;
    }
    for (std::uint32_t v = 0; v < point_.size(); ++v) point_[v] = gradient_run_.variable(v);
    if (is_concave()) return false;
    const std::vector<Interval> before = point_;
    const Newton::Outcome outcome = newton_.contract(point_, rows_, columns_);
    if (outcome == Newton::Outcome::empty) return false;
    const auto is_less = [](const Interval& x, const Interval& was) {
      constexpr double kMuch = 0.9;
      return width_of(x) < kMuch * width_of(was);
    };
    if (outcome == Newton::Outcome::nothing ||
        std::equal(point_.begin(), point_.end(), before.begin(), std::not_fn(is_less)))
      break;
  }
  std::copy(point_.begin(), point_.end(), box.begin());
  return true;
}

// Those of which a little more than the box is in the domain still.
bool Stationary::find_free(const std::vector<Interval>& box) {
  rows_.clear();
  columns_.clear();
  around_ = box;
  around_.push_back(Interval::entire());
  for (std::uint32_t row = 0; row < problem_.gradient_unknowns.size(); ++row) {
    const std::uint32_t v = problem_.gradient_unknowns[row];
    const Interval wider = Interval::raw(up::next_down(box[v].lo()), up::next_up(box[v].hi()));
    if (!leq(wider, problem_.constraints.certain[v])) continue;
    around_[v] = wider;
    rows_.push_back(row);
    columns_.push_back(v);
  }
  return !rows_.empty();
}

// Whether the objective is smooth in a neighbourhood of the box, in which no constraint is active.
bool Stationary::is_inside() {
  const auto& relations = problem_.with_value.relations;
  run_.evaluate(around_, true);
  for (std::size_t i = 0; i < relations.size(); ++i) {
    if (relations[i].is_implied) continue;
    if (!run_.is_continuous(i)) return false;
    if (i > 0 && (relations[i].is_equation() || !(run_.value(i).hi() < 0.0))) return false;
  }
  run_.gradient(0, slopes_);
  for (const std::uint32_t v : columns_) {
    if (slopes_[v].is_empty() || !slopes_[v].is_bounded()) return false;
  }
  keep_defined();
  if (rows_.empty()) return false;
  if (problem_.constraints.choices.empty()) return true;
  return choices_.all_hold({around_.begin(), around_.end() - 1});
}

// A slope that exists may be written as what does not: of 0 norm(x) at 0 it is 0 x/norm(x), which HC4-revise
// would call impossible.
void Stationary::keep_defined() {
  gradient_run_.evaluate({around_.data(), around_.size() - 1}, false);
  std::size_t kept = 0;
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    if (!gradient_run_.is_continuous(rows_[k])) continue;
    rows_[kept] = rows_[k];
    columns_[kept++] = columns_[k];
  }
  rows_.resize(kept);
  columns_.resize(kept);
}

// Whether the objective bends down along some unknown everywhere.
bool Stationary::is_concave() {
  forms_.expand_over(point_);
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    if (forms_.has_form(rows_[k]) && forms_.slopes(rows_[k])[columns_[k]].hi() < 0.0) return true;
  }
  return false;
}

}  // namespace hcsp
