// SPDX-License-Identifier: Apache-2.0
#include "solver/search/mean_value.h"

#include <algorithm>
#include <cmath>

#include "domains/interval/kernel.h"

namespace hcsp {

namespace {

constexpr Interval kZero = Interval::raw(0.0, 0.0);

}  // namespace

MeanValueForms::MeanValueForms(const System& system) : system_(system), run_(*system.tape) {
  for (std::uint32_t i = 0; i < system.relations.size(); ++i) {
    if (system.relations[i].is_equation()) equations_.push_back(i);
  }
  const std::size_t n = system.size();
  slopes_.assign(size(), std::vector<Interval>(n, kZero));
  values_.resize(size());
  has_form_.resize(size());
  center_.resize(n);
  combined_.slopes.resize(n);
  smear_.resize(n);
}

void MeanValueForms::expand_over(const std::vector<Interval>& box) {
  if (box_ == box) return;
  box_ = box;
  find_center(box);
  run_.evaluate(box, true);
  for (std::size_t e = 0; e < size(); ++e) {
    run_.gradient(equations_[e], slopes_[e]);
    see_whether_form_holds(e);
  }
}

void MeanValueForms::expand_from_center(const std::vector<Interval>& box) {
  box_.clear();
  find_center(box);
  run_.evaluate_from(center_, box);
  for (std::size_t e = 0; e < size(); ++e) {
    values_[e] = up::sub(run_.value_at_center(equations_[e]), system_.relations[equations_[e]].wanted);
    run_.slopes(equations_[e], slopes_[e]);
    see_whether_form_holds(e);
  }
}

void MeanValueForms::find_center(const std::vector<Interval>& box) {
  for (std::size_t v = 0; v < box.size(); ++v) {
    const double middle = middle_of(box[v]);
    center_[v] = Interval::raw(middle, middle);
  }
}

void MeanValueForms::see_whether_form_holds(std::size_t e) {
  const auto own = unknowns(e);
  has_form_[e] =
      run_.is_continuous(equations_[e]) && std::all_of(own.begin(), own.end(), [&](std::uint32_t v) {
        return slopes_[e][v].is_bounded() && !slopes_[e][v].is_empty();
      });
}

void MeanValueForms::evaluate_at_center() {
  run_.evaluate(center_, false);
  for (std::size_t e = 0; e < size(); ++e)
    values_[e] = up::sub(run_.value(equations_[e]), system_.relations[equations_[e]].wanted);
}

const MeanValueForms::Form& MeanValueForms::combine(std::span<const std::uint32_t> equations,
                                                    std::span<const double> factors) {
  auto& [value, slopes] = combined_;
  value = kZero;
  std::fill(slopes.begin(), slopes.end(), kZero);
  for (std::size_t k = 0; k < equations.size(); ++k) {
    if (factors[k] == 0.0) continue;
    const std::uint32_t e = equations[k];
    const Interval factor = Interval::raw(factors[k], factors[k]);
    value = up::add(value, up::mul(factor, values_[e]));
    for (const std::uint32_t v : unknowns(e)) slopes[v] = up::add(slopes[v], up::mul(factor, slopes_[e][v]));
  }
  return combined_;
}

// How much an equation varies over the box of expand_over() with an unknown.
double MeanValueForms::variation(std::size_t e, std::uint32_t v) const {
  constexpr double kMost = 1e100;
  const double slope = slopes_[e][v].mag();
  return slope == 0.0 ? 0.0 : std::min(slope * width_of(box_[v]), kMost);
}

const std::vector<double>& MeanValueForms::smear(const std::vector<Interval>& box) {
  expand_over(box);
  std::fill(smear_.begin(), smear_.end(), 0.0);
  for (std::size_t e = 0; e < size(); ++e) {
    double total = 0.0;
    for (const std::uint32_t v : unknowns(e)) total += variation(e, v);
    if (total == 0.0) continue;
    for (const std::uint32_t v : unknowns(e)) smear_[v] += variation(e, v) / total;
  }
  return smear_;
}

const std::vector<double>& MeanValueForms::smear_max(const std::vector<Interval>& box) {
  expand_over(box);
  std::fill(smear_.begin(), smear_.end(), 0.0);
  for (std::size_t e = 0; e < size(); ++e) {
    for (const std::uint32_t v : unknowns(e)) smear_[v] = std::max(smear_[v], variation(e, v));
  }
  return smear_;
}

}  // namespace hcsp
