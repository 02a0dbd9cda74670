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
    : system_(system), forms_(system), newton_(system, forms_), choices_(system), run_(*system.tape) {}

bool FeasiblePoint::find(std::vector<double> near) {
  put_in_domains(near);
  if (forms_.size() == 0) {
    box_.clear();
    for (const double x : near) box_.push_back(Interval::raw(x, x));
    return holds();
  }
  return forms_.size() <= system_.size() && correct(near) && choose_solved(near) && prove(near);
}

void FeasiblePoint::put_in_domains(std::vector<double>& point) const {
  for (std::size_t v = 0; v < point.size(); ++v) {
    if (system_.is_whole[v] != 0) point[v] = std::round(point[v]);
    point[v] = std::clamp(point[v], system_.domains[v].lo(), system_.domains[v].hi());
  }
}

// How far an unknown can move before it leaves its domain, where that is little.
double FeasiblePoint::room(std::size_t v, double x) const {
  if (system_.is_whole[v] != 0) return 0.0;
  const Interval& domain = system_.domains[v];
  return std::min({std::max(std::abs(x), 1.0), x - domain.lo(), domain.hi() - x});
}

void FeasiblePoint::linearise(const std::vector<double>& point) {
  const std::size_t m = forms_.size(), n = point.size();
  std::vector<Interval> box;
  for (const double x : point) box.push_back(Interval::raw(x, x));
  forms_.expand_over(box);
  forms_.evaluate_at_center();
  jacobian_.setZero(at(m), at(n));
  values_.resize(at(m));
  room_.resize(at(n));
  for (std::size_t v = 0; v < n; ++v) room_[at(v)] = room(v, point[v]);
  for (std::uint32_t e = 0; e < m; ++e) {
    const double one = 1.0;
    values_[at(e)] = middle_of(forms_.combine({&e, 1}, {&one, 1}).value);
    for (const std::uint32_t v : forms_.unknowns(e))
      jacobian_(at(e), at(v)) = middle_of(forms_.slopes(e)[v]) * room_[at(v)];
  }
}

// Newton's method towards the equations' nearest solution, in floating point.
bool FeasiblePoint::correct(std::vector<double>& point) {
  constexpr int kMostSteps = 12;
  double best = kInfinity;
  for (int k = 0; k < kMostSteps; ++k) {
    linearise(point);
    if (!jacobian_.allFinite() || !values_.allFinite()) return false;
    const double now = values_.lpNorm<Eigen::Infinity>();
    constexpr double kGain = 0.5;
    if (now == 0.0) return true;
    if (k > 3 && now > kGain * best) return true;
    best = std::min(best, now);
    Eigen::VectorXd step;
    {
      const RoundNearest nearest;
      step = jacobian_.completeOrthogonalDecomposition().solve(-values_).cwiseProduct(room_);
    }
    if (!step.allFinite()) return false;
    for (std::size_t v = 0; v < point.size(); ++v) point[v] += step[at(v)];
    put_in_domains(point);
  }
  return true;
}

// The unknowns that move the equations most within their room.
bool FeasiblePoint::choose_solved(const std::vector<double>& point) {
  linearise(point);
  if (!jacobian_.allFinite()) return false;
  const RoundNearest nearest;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(jacobian_);
  if (static_cast<std::size_t>(qr.rank()) < forms_.size()) return false;
  solved_.clear();
  for (std::size_t k = 0; k < forms_.size(); ++k)
    solved_.push_back(static_cast<std::uint32_t>(qr.colsPermutation().indices()[at(k)]));
  return true;
}

bool FeasiblePoint::prove(const std::vector<double>& point) {
  for (const double width : {1e-13, 1e-11, 1e-9, 1e-7, 1e-5}) {
    reach_.clear();
    for (const double x : point) reach_.push_back(Interval::raw(x, x));
    for (const std::uint32_t v : solved_) {
      const double radius = width * std::max(std::abs(point[v]), 1.0);
      reach_[v] = Interval::raw(-(radius - point[v]), point[v] + radius);
    }
    if (!newton_.prove_in(reach_, solved_)) continue;
    box_ = newton_.enclosure();
    return holds();
  }
  return false;
}

// Every point of the box lies in the domains and satisfies all but equations.
bool FeasiblePoint::holds() {
  for (std::size_t v = 0; v < box_.size(); ++v) {
    const bool is_whole = system_.is_whole[v] == 0 || (box_[v].is_point() && std::round(box_[v].lo()) == box_[v].lo());
    if (!is_whole || !leq(box_[v], system_.domains[v])) return false;
  }
  run_.evaluate(box_, false);
  for (std::size_t i = 0; i < system_.relations.size(); ++i) {
    const System::Relation& relation = system_.relations[i];
    if (relation.is_equation()) continue;
    const double most = run_.value(i).hi();
    if (!(relation.strict ? most < 0.0 : most <= 0.0) || !run_.is_continuous(i)) return false;
  }
  return choices_.all_hold(box_);
}

}  // namespace hcsp
