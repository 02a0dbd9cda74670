// SPDX-License-Identifier: Apache-2.0
#include "solver/search/local_search.h"

#include <algorithm>
#include <cmath>

#include "solver/search/mean_value.h"

namespace hcsp {

LocalSearch::LocalSearch(const Minimisation& problem)
    : problem_(problem), run_(*problem.with_value.tape), box_(problem.with_value.size()) {
  const Interval zero = Interval::raw(0.0, 0.0);
  slopes_.assign(problem.with_value.relations.size(), std::vector<Interval>(problem.with_value.size(), zero));
  size_.resize(slopes_.size());
}

// The objective's value is minus the first relation's where the unknown that stands for it is 0.
bool LocalSearch::evaluate(const std::vector<double>& point, Place& place) {
  for (std::size_t v = 0; v < point.size(); ++v) box_[v] = Interval::raw(point[v], point[v]);
  box_.back() = Interval::raw(0.0, 0.0);
  run_.evaluate(box_, true);
  const auto& relations = problem_.with_value.relations;
  place.values.resize(relations.size());
  place.violation = 0.0;
  for (std::size_t i = 0; i < relations.size(); ++i) {
    const Interval& value = run_.value(i);
    if (value.is_empty() || !value.is_bounded()) return false;
    place.values[i] = middle_of(value);
    if (i == 0) continue;
    if (relations[i].is_equation()) {
      place.violation += std::abs(place.values[i]);
    } else {
      place.violation += std::max(place.values[i] + margin_ * size_[i], 0.0);
    }
  }
  place.objective = -place.values[0];
  return true;
}

void LocalSearch::expand(const std::vector<double>& point) {
  for (std::size_t i = 0; i < slopes_.size(); ++i) {
    run_.gradient(i, slopes_[i]);
    size_[i] = 1.0;
    for (const std::uint32_t v : problem_.with_value.tape->variables(i)) {
      Interval& slope = slopes_[i][v];
      if (slope.is_empty() || !slope.is_bounded()) slope = Interval::raw(0.0, 0.0);
      if (v < point.size()) size_[i] = std::max(size_[i], std::abs(middle_of(slope) * point[v]));
    }
  }
}

// Minimises the linearised objective plus the penalty for what the linearised constraints are violated.
bool LocalSearch::step(const std::vector<double>& point, const Place& place, std::vector<double>& next,
                       double& promised) {
  const System& system = problem_.with_value;
  const std::size_t n = point.size();
  std::vector<Interval> columns;
  for (std::size_t v = 0; v < n; ++v) {
    const Interval& domain = system.domains[v];
    const double scale =
        system.is_whole[v] != 0
            ? 0.0
            : std::min(std::max(1.0, std::abs(point[v])), domain.is_bounded() ? width_of(domain) : kInfinity);
    columns.push_back(Interval::raw(std::max(-radius_ * scale, std::min(domain.lo() - point[v], 0.0)),
                                    std::min(radius_ * scale, std::max(domain.hi() - point[v], 0.0))));
  }
  std::vector<LinearTerm> objective;
  for (const std::uint32_t v : system.tape->variables(0)) {
    if (v < n) objective.push_back({v, -middle_of(slopes_[0][v])});
  }
  struct Elastic {
    double below, above;
  };
  std::vector<Elastic> elastic;
  for (std::uint32_t i = 1; i < system.relations.size(); ++i) {
    const bool is_equation = system.relations[i].is_equation();
    columns.push_back(Interval::raw(0.0, kInfinity));
    objective.push_back({static_cast<std::uint32_t>(columns.size() - 1), penalty_});
    if (!is_equation) continue;
    columns.push_back(Interval::raw(0.0, kInfinity));
    objective.push_back({static_cast<std::uint32_t>(columns.size() - 1), penalty_});
  }
  program_.start(columns);
  std::uint32_t slack = static_cast<std::uint32_t>(n);
  std::vector<LinearTerm> row;
  for (std::uint32_t i = 1; i < system.relations.size(); ++i) {
    row.clear();
    for (const std::uint32_t v : system.tape->variables(i)) row.push_back({v, middle_of(slopes_[i][v])});
    row.push_back({slack++, -1.0});
    if (system.relations[i].is_equation()) {
      row.push_back({slack++, 1.0});
      program_.add_row(row, Interval::raw(-place.values[i], -place.values[i]));
    } else {
      program_.add_row(row, Interval::raw(-kInfinity, -(margin_ * size_[i]) - place.values[i]));
    }
  }
  if (program_.rows() == 0) {  // down the slope, as far as the region reaches
    next = point;
    promised = 0.0;
    for (const LinearTerm& term : objective) {
      const double move = term.factor > 0 ? columns[term.column].lo() : columns[term.column].hi();
      next[term.column] += move;
      promised -= term.factor * move;
    }
    return true;
  }
  if (!program_.solve(objective)) return false;
  const auto solution = program_.solution();
  next = point;
  double after = 0.0;
  for (std::size_t v = 0; v < n; ++v) next[v] += solution[v];
  for (const LinearTerm& term : objective) after += term.factor * solution[term.column];
  promised = penalty_ * place.violation - after;
  return true;
}

void LocalSearch::improve(std::vector<double>& point, double margin, int most_steps) {
  margin_ = margin;
  radius_ = 0.5;
  std::fill(size_.begin(), size_.end(), 1.0);
  Place here, there;
  if (!problem_.has_slopes || !evaluate(point, here)) return;
  expand(point);
  penalty_ = 1.0;
  for (const std::uint32_t v : problem_.with_value.tape->variables(0))
    penalty_ = std::max(penalty_, 10.0 * slopes_[0][v].mag());
  std::vector<double> next;
  for (int k = 0; k < most_steps; ++k) {
    double promised = 0.0;
    if (!step(point, here, next, promised)) return;
    const double merit = here.objective + penalty_ * here.violation;
    constexpr double kNoise = 1e-15;
    if (!(promised > kNoise * (1.0 + std::abs(merit)))) return;
    const bool is_defined = evaluate(next, there);
    const double gained = is_defined ? merit - (there.objective + penalty_ * there.violation) : -kInfinity;
    constexpr double kFair = 0.1, kGood = 0.7, kLeast = 1e-11;
    if (gained > kFair * promised) {
      point = next;
      std::swap(here, there);
      expand(point);
    }
    if (gained > kGood * promised) radius_ *= 2.0;
    if (!(gained > kFair * promised)) radius_ *= 0.3;
    if (radius_ < kLeast) return;
  }
}

}  // namespace hcsp
