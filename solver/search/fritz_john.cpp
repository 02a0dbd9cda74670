// SPDX-License-Identifier: Apache-2.0
#include "solver/search/fritz_john.h"

#include <algorithm>
#include <cmath>

#include "domains/interval/kernel.h"
#include "solver/search/mean_value.h"

namespace hcsp {

FritzJohn::FritzJohn(const Minimisation& problem)
    : problem_(problem), run_(*problem.with_value.tape), choices_(problem.constraints) {
  slopes_.assign(problem.with_value.relations.size(),
                 std::vector<Interval>(problem.with_value.size(), Interval::raw(0.0, 0.0)));
  const auto is_equation = [](const System::Relation& relation) {
    return relation.is_equation() && !relation.is_implied;
  };
  equations_ = static_cast<std::size_t>(
      std::count_if(problem.constraints.relations.begin(), problem.constraints.relations.end(), is_equation));
}

// An equation's multiplier has either sign: each choice of signs is a program, since with both in one they
// would cancel.
bool FritzJohn::may_hold_minimiser(const std::vector<Interval>& box) {
  constexpr std::size_t kMostEquations = 3;
  if (equations_ > kMostEquations || !expand_around(box)) return true;
  for (std::uint32_t signs = 0; signs >> equations_ == 0; ++signs) {
    if (may_have_multipliers(signs)) return true;
  }
  return false;
}

bool FritzJohn::may_have_multipliers(std::uint32_t signs) {
  collect_multipliers(signs);
  program_.start(std::vector<Interval>(multipliers_.size(), Interval::raw(0.0, 1.0)));
  std::vector<LinearTerm> sum;
  for (std::uint32_t k = 0; k < multipliers_.size(); ++k) sum.push_back({k, 1.0});
  program_.add_row(sum, Interval::raw(1.0, 1.0));
  for (std::uint32_t v = 0; v < problem_.value(); ++v) add_row(v);
  return program_.contract(0, true);
}

// Whether all functions are defined and continuous in a neighbourhood of the box, with slopes, and choices
// hold there.
bool FritzJohn::expand_around(const std::vector<Interval>& box) {
  if (!problem_.has_slopes) return false;
  around_ = box;
  for (std::size_t v = 0; v + 1 < box.size(); ++v) {
    if (!box[v].is_bounded()) return false;
    if (problem_.constraints.is_whole[v] == 0)
      around_[v] = Interval::raw(up::next_down(box[v].lo()), up::next_up(box[v].hi()));
  }
  around_.back() = Interval::raw(0.0, 0.0);
  run_.evaluate(around_, true);
  for (std::size_t i = 0; i < slopes_.size(); ++i) {
    if (problem_.with_value.relations[i].is_implied) continue;
    if (!run_.is_continuous(i)) return false;
    run_.gradient(i, slopes_[i]);
  }
  return problem_.constraints.choices.empty() || choices_.all_hold({around_.begin(), around_.end() - 1});
}

// Of an equation with the sign of the next bit; of an inequality that holds all over, none.
void FritzJohn::collect_multipliers(std::uint32_t signs) {
  multipliers_.clear();
  for (std::uint32_t i = 0; i < slopes_.size(); ++i) {
    if (problem_.with_value.relations[i].is_implied) continue;
    const bool is_equation = i > 0 && problem_.with_value.relations[i].is_equation();
    if (i > 0 && !is_equation && run_.value(i).hi() < 0.0) continue;
    double most = 0.0;
    for (const std::uint32_t v : problem_.with_value.tape->variables(i)) {
      if (v != problem_.value() && slopes_[i][v].is_bounded()) most = std::max(most, slopes_[i][v].mag());
    }
    const double scale = most > 0.0 ? std::ldexp(1.0, -std::clamp(std::ilogb(most), -500, 500)) : 1.0;
    const bool is_turned = i == 0 || (is_equation && (signs & 1U) != 0);
    multipliers_.push_back({i, is_turned ? -1.0 : 1.0, scale});
    if (is_equation) signs >>= 1U;
  }
}

// "The sum of slopes along an unknown is 0", or not less at the lower bound of its domain, not more at the
// upper one: what that says of multipliers that are not negative, whatever the slopes within their intervals.
void FritzJohn::add_row(std::uint32_t v) {
  const Interval& domain = problem_.constraints.certain[v];
  if (problem_.constraints.is_whole[v] != 0 || domain.is_empty()) return;
  const bool is_off_lower = around_[v].lo() >= domain.lo(), is_off_upper = around_[v].hi() <= domain.hi();
  std::vector<LinearTerm> least, most;
  for (std::uint32_t k = 0; k < multipliers_.size(); ++k) {
    const auto& [relation, sign, scale] = multipliers_[k];
    const Interval& slope = slopes_[relation][v];
    if (slope.is_empty() || !slope.is_bounded()) return;
    if (slope == Interval::raw(0.0, 0.0)) continue;
    const Interval part = up::mul(slope, Interval::raw(sign * scale, sign * scale));
    least.push_back({k, part.lo()});
    most.push_back({k, part.hi()});
  }
  if (least.empty()) return;
  if (is_off_lower) program_.add_row(least, Interval::raw(-kInfinity, 0.0));
  if (is_off_upper) program_.add_row(most, Interval::raw(0.0, kInfinity));
}

}  // namespace hcsp
