// SPDX-License-Identifier: Apache-2.0
#include "solver/search/feasible_point.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "domains/rounding.h"

namespace hcsp {

namespace {

Eigen::Index at(std::size_t i) { return static_cast<Eigen::Index>(i); }

}  // namespace

FeasiblePoint::FeasiblePoint(const System& system)
    : system_(system),
      forms_(system),
      newton_(system, forms_),
      choices_(system),
      run_(*system.tape),
      is_active_(system.relations.size()),
      slopes_(system.size()) {
  for (std::uint32_t i = 0; i < system.relations.size(); ++i) {
    if (system.relations[i].is_equation()) equations_.push_back(i);
  }
  const RoundUpward guard;
  is_implied_ = implied_equations(system);
}

bool FeasiblePoint::find(std::vector<double> near) {
  put_in_domains(near);
  std::fill(is_active_.begin(), is_active_.end(), 0);
  return correct(near) && choose_solved(near) && prove(near);
}

// What is next to a bound goes there: it may have to.
void FeasiblePoint::put_in_domains(std::vector<double>& point) const {
  constexpr double kNext = 1e-9;
  for (std::size_t v = 0; v < point.size(); ++v) {
    double& x = point[v];
    const Interval& domain = system_.certain[v];
    if (system_.is_whole[v] != 0) x = std::round(x);
    const double next = kNext * std::max(std::abs(x), 1.0);
    if (x < domain.lo() + next) x = domain.lo();
    if (x > domain.hi() - next) x = domain.hi();
    if (x == 0.0 || std::abs(x) < 1e-14) x = 0.0;
  }
}

// How far an unknown can move before it leaves its domain, where that is little.
double FeasiblePoint::room(std::size_t v, double x) const {
  if (system_.is_whole[v] != 0) return 0.0;
  const Interval& domain = system_.certain[v];
  return std::min({std::max(std::abs(x), 1.0), x - domain.lo(), domain.hi() - x});
}

// Collects the equations that are not implied, and the inequalities that are violated, or were, at a point.
bool FeasiblePoint::evaluate(const std::vector<double>& point) {
  box_.clear();
  for (const double x : point) box_.push_back(Interval::raw(x, x));
  run_.evaluate(box_, true);
  rows_.clear();
  std::size_t number = 0;
  for (std::uint32_t i = 0; i < system_.relations.size(); ++i) {
    const System::Relation& relation = system_.relations[i];
    if (relation.is_implied) {
      number += relation.is_equation() ? 1 : 0;
      continue;
    }
    const Interval& value = run_.value(i);
    if (value.is_empty() || !value.is_bounded()) return false;
    if (relation.is_equation()) {
      if (is_implied_[number++] == 0) rows_.push_back({i, middle_of(value)});
      continue;
    }
    const bool holds = relation.strict ? value.hi() < 0.0 : value.hi() <= 0.0;
    if (holds && is_active_[i] == 0) continue;
    is_active_[i] = 1;
    constexpr double kNoise = 4.0;  // times what rounding may do
    rows_.push_back({i, value.hi() + kNoise * width_of(value)});
  }
  return true;
}

Eigen::MatrixXd FeasiblePoint::jacobian(const std::vector<double>& point) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(at(rows_.size()), at(point.size()));
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    run_.gradient(rows_[k].relation, slopes_);
    for (const std::uint32_t v : system_.tape->variables(rows_[k].relation))
      result(at(k), at(v)) = middle_of(slopes_[v]) * room(v, point[v]);
  }
  return result;
}

// Newton's method towards the nearest point where the equations and the inequalities that were violated hold,
// in floating point.
bool FeasiblePoint::correct(std::vector<double>& point) {
  constexpr int kMostSteps = 15, kFirst = 4;
  double best = kInfinity;
  for (int k = 0; k < kMostSteps; ++k) {
    if (!evaluate(point)) return false;
    Eigen::VectorXd values(at(rows_.size()));
    double now = 0.0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      values[at(i)] = rows_[i].value;
      const bool is_equation = system_.relations[rows_[i].relation].is_equation();
      now = std::max(now, is_equation ? std::abs(rows_[i].value) : rows_[i].value);
    }
    if (now <= 0.0 || (k > kFirst && now > 0.5 * best)) return true;
    best = std::min(best, now);
    const Eigen::MatrixXd matrix = jacobian(point);
    if (!matrix.allFinite()) return false;
    const RoundNearest nearest;
    const Eigen::VectorXd step = matrix.completeOrthogonalDecomposition().solve(-values);
    if (!step.allFinite()) return false;
    for (std::size_t v = 0; v < point.size(); ++v) point[v] += step[at(v)] * room(v, point[v]);
    put_in_domains(point);
  }
  return evaluate(point);
}

// The unknowns that move the equations most within their room; an equation that nothing moves may be 0 as it
// is.
bool FeasiblePoint::choose_solved(const std::vector<double>& point) {
  solved_.clear();
  solved_by_.clear();
  std::fill(is_active_.begin(), is_active_.end(), 0);
  evaluate(point);
  std::erase_if(rows_, [&](const Row& row) {
    run_.gradient(row.relation, slopes_);
    const auto own = system_.tape->variables(row.relation);
    const bool is_moved = std::any_of(own.begin(), own.end(), [&](std::uint32_t v) {
      return middle_of(slopes_[v]) * room(v, point[v]) != 0.0;
    });
    return !system_.relations[row.relation].is_equation() || !is_moved;
  });
  if (rows_.empty()) return true;
  const Eigen::MatrixXd matrix = jacobian(point);
  if (rows_.size() > point.size() || !matrix.allFinite()) return false;
  const RoundNearest nearest;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(matrix);
  if (static_cast<std::size_t>(qr.rank()) < rows_.size()) return false;
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    solved_.push_back(static_cast<std::uint32_t>(qr.colsPermutation().indices()[at(k)]));
    const auto number =
        std::find(equations_.begin(), equations_.end(), rows_[k].relation) - equations_.begin();
    solved_by_.push_back(static_cast<std::uint32_t>(number));
  }
  return true;
}

bool FeasiblePoint::prove(const std::vector<double>& point) {
  reach_.clear();
  for (const double x : point) reach_.push_back(Interval::raw(x, x));
  if (solved_.empty()) {
    box_ = reach_;
    return holds();
  }
  for (const double width : {1e-13, 1e-11, 1e-9, 1e-7, 1e-5}) {
    for (const std::uint32_t v : solved_) {
      const double radius = width * std::max(std::abs(point[v]), 1.0);
      reach_[v] = Interval::raw(-(radius - point[v]), point[v] + radius);
    }
    if (!newton_.prove_in(reach_, solved_by_, solved_)) continue;
    box_ = newton_.enclosure();
    return holds();
  }
  return false;
}

// Every point of the box lies in the domains and satisfies all but equations.
bool FeasiblePoint::holds() {
  for (std::size_t v = 0; v < box_.size(); ++v) {
    const bool is_whole =
        system_.is_whole[v] == 0 || (box_[v].is_point() && std::round(box_[v].lo()) == box_[v].lo());
    if (!is_whole || !leq(box_[v], system_.certain[v])) return false;
  }
  run_.evaluate(box_, false);
  std::size_t equation = 0;
  for (std::size_t i = 0; i < system_.relations.size(); ++i) {
    const System::Relation& relation = system_.relations[i];
    if (relation.is_implied) {
      equation += relation.is_equation() ? 1 : 0;
      continue;
    }
    if (relation.is_equation()) {
      const auto number = static_cast<std::uint32_t>(equation++);
      const bool is_proven =
          is_implied_[number] != 0 || std::count(solved_by_.begin(), solved_by_.end(), number) != 0;
      if (!is_proven && !(run_.value(i) == Interval::raw(0.0, 0.0))) return false;
      if (!run_.is_continuous(i)) return false;
      continue;
    }
    const double most = run_.value(i).hi();
    if (!(relation.strict ? most < 0.0 : most <= 0.0) || !run_.is_continuous(i)) return false;
  }
  return choices_.all_hold(box_);
}

}  // namespace hcsp
