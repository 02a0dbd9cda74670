// SPDX-License-Identifier: Apache-2.0
#include "solver/search/elimination.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "domains/interval/kernel.h"

namespace hcsp {

namespace {

constexpr Interval kZero = Interval::raw(0.0, 0.0);
// An equation that bends less over the box may be eliminated from straighter ones too.
constexpr double kStraight = 1e-3;
// A pivot below this part of its equation is rounding noise.
constexpr double kNoise = 1e-10;

double middle_of(const Interval& x) { return 0.5 * x.lo() + 0.5 * x.hi(); }
double width_of(const Interval& x) { return x.hi() - x.lo(); }
Eigen::Index at(std::size_t i) { return static_cast<Eigen::Index>(i); }

}  // namespace

Elimination::Elimination(const System& system) : system_(system), run_(*system.tape) {
  for (std::uint32_t i = 0; i < system.relations.size(); ++i) {
    if (system.relations[i].is_equation()) equations_.push_back(i);
  }
  const std::size_t n = system.unknowns.size(), m = equations_.size();
  slopes_.assign(m, std::vector<Interval>(n, kZero));
  values_.resize(m);
  bend_.resize(m);
  for (auto* each : {&center_, &row_, &terms_}) each->resize(n);
  sums_.resize(n + 1);
}

bool Elimination::contract(std::vector<Interval>& box) {
  if (equations_.size() < 2 || !expand(box)) return true;
  eliminate(box);
  return std::all_of(order_.begin(), order_.end(), [&](std::uint32_t e) { return contract_by(at(e), box); });
}

// The mean value forms; false where there are none.
bool Elimination::expand(const std::vector<Interval>& box) {
  if (!std::all_of(box.begin(), box.end(), [](const Interval& x) { return x.is_bounded(); })) return false;
  run_.evaluate(box, true);
  order_.clear();
  for (std::uint32_t e = 0; e < equations_.size(); ++e) {
    run_.gradient(equations_[e], slopes_[e]);
    double bent = 0.0, total = 0.0;
    bool has_form = run_.is_continuous(equations_[e]);
    for (const std::uint32_t v : system_.tape->variables(equations_[e])) {
      const Interval& slope = slopes_[e][v];
      has_form = has_form && slope.is_bounded() && !slope.is_empty();
      bent += 0.5 * width_of(slope) * width_of(box[v]);
      total += slope.mag() * width_of(box[v]);
    }
    bend_[e] = total > 0.0 ? bent / total : 0.0;
    if (has_form && total > 0.0) order_.push_back(e);
  }
  std::stable_sort(order_.begin(), order_.end(), [&](auto a, auto b) { return bend_[a] < bend_[b]; });
  for (std::size_t v = 0; v < box.size(); ++v) {
    const double middle = middle_of(box[v]);
    center_[v] = Interval::raw(middle, middle);
  }
  run_.evaluate(center_, false);
  for (const std::uint32_t e : order_)
    values_[e] = up::sub(run_.value(equations_[e]), system_.relations[equations_[e]].wanted);
  return order_.size() > 1;
}

void Elimination::eliminate(const std::vector<Interval>& box) {
  const std::size_t n = box.size(), m = equations_.size();
  middle_.setZero(at(m), at(n));
  combination_.setIdentity(at(m), at(m));
  for (const std::uint32_t e : order_) {
    for (const std::uint32_t v : system_.tape->variables(equations_[e]))
      middle_(at(e), at(v)) = middle_of(slopes_[e][v]);
  }
  std::vector<bool> used(n, false);
  for (std::size_t k = 0; k < order_.size(); ++k) {
    const Eigen::Index e = at(order_[k]);
    // The unknown that the equation leaves most open.
    std::size_t pivot = n;
    double most = 0.0, total = 0.0;
    for (std::size_t v = 0; v < n; ++v) {
      const double part = std::abs(middle_(e, at(v))) * width_of(box[v]);
      total += part;
      if (used[v] || part <= most) continue;
      most = part;
      pivot = v;
    }
    if (pivot == n || most <= kNoise * total) continue;
    used[pivot] = true;
    for (std::size_t j = 0; j < order_.size(); ++j) {
      const Eigen::Index other = at(order_[j]);
      if (j == k || (j < k && bend_[order_[k]] > kStraight) || middle_(other, at(pivot)) == 0.0) continue;
      const double factor = middle_(other, at(pivot)) / middle_(e, at(pivot));
      middle_.row(other) -= factor * middle_.row(e);
      middle_(other, at(pivot)) = 0.0;
      combination_.row(other) -= factor * combination_.row(e);
    }
  }
}

// Forward and backward through the sum of a combination's terms.
bool Elimination::contract_by(Eigen::Index row, std::vector<Interval>& box) {
  const std::size_t n = box.size();
  Interval value = kZero;
  std::fill(row_.begin(), row_.end(), kZero);
  for (const std::uint32_t e : order_) {
    const double entry = combination_(row, at(e));
    if (entry == 0.0) continue;
    const Interval factor = Interval::raw(entry, entry);
    value = up::add(value, up::mul(factor, values_[e]));
    for (const std::uint32_t v : system_.tape->variables(equations_[e]))
      row_[v] = up::add(row_[v], up::mul(factor, slopes_[e][v]));
  }
  if (!value.is_bounded()) return true;
  sums_[0] = value;
  for (std::size_t v = 0; v < n; ++v) {
    terms_[v] = up::mul(row_[v], up::sub(box[v], center_[v]));
    sums_[v + 1] = up::add(sums_[v], terms_[v]);
  }
  if (!sums_[n].contains(0.0)) return false;
  Interval rest = kZero;  // what the terms from here on have to make up
  for (std::size_t v = n; v-- > 0;) {
    const Interval term = meet(terms_[v], up::sub(rest, sums_[v]));
    if (term.is_empty()) return false;
    if (!(term == terms_[v])) {
      const Interval offset = up::mul_rev(row_[v], term, up::sub(box[v], center_[v]));
      box[v] = meet(box[v], up::add(center_[v], offset));
      if (box[v].is_empty()) return false;
    }
    rest = up::sub(rest, terms_[v]);
  }
  return true;
}

}  // namespace hcsp
