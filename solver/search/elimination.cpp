// SPDX-License-Identifier: Apache-2.0
#include "solver/search/elimination.h"

#include <algorithm>
#include <cmath>

#include "domains/interval/kernel.h"

namespace hcsp {

namespace {

// An equation that bends less over the box may be eliminated from straighter ones too.
constexpr double kStraight = 1e-3;
// A pivot below this part of its equation is rounding noise.
constexpr double kNoise = 1e-10;

Eigen::Index at(std::size_t i) { return static_cast<Eigen::Index>(i); }

}  // namespace

bool Elimination::contract(std::vector<Interval>& box) {
  if (forms_.size() < 2 || !is_bounded(box)) return true;
  forms_.expand_from_center(box);
  order(box);
  if (order_.size() < 2) return true;
  eliminate(box);
  for (Eigen::Index k = 0; k < combination_.rows(); ++k) {
    const std::span<const double> factors(combination_.row(k).data(), order_.size());
    if (!contract_by(forms_.combine(order_, factors), box)) return false;
  }
  return true;
}

void Elimination::order(const std::vector<Interval>& box) {
  order_.clear();
  bend_.resize(forms_.size());
  for (std::uint32_t e = 0; e < forms_.size(); ++e) {
    double bent = 0.0, total = 0.0;
    for (const std::uint32_t v : forms_.unknowns(e)) {
      const Interval& slope = forms_.slopes(e)[v];
      bent += 0.5 * width_of(slope) * width_of(box[v]);
      total += slope.mag() * width_of(box[v]);
    }
    bend_[e] = total > 0.0 ? bent / total : 0.0;
    if (forms_.has_form(e) && total > 0.0) order_.push_back(e);
  }
  std::stable_sort(order_.begin(), order_.end(), [&](auto a, auto b) { return bend_[a] < bend_[b]; });
}

void Elimination::eliminate(const std::vector<Interval>& box) {
  const std::size_t n = box.size(), m = order_.size();
  middle_.setZero(at(m), at(n));
  combination_.setIdentity(at(m), at(m));
  for (std::size_t k = 0; k < m; ++k) {
    for (const std::uint32_t v : forms_.unknowns(order_[k]))
      middle_(at(k), at(v)) = middle_of(forms_.slopes(order_[k])[v]);
  }
  std::vector<bool> used(n, false);
  for (std::size_t k = 0; k < m; ++k) {
    const auto row = middle_.row(at(k));
    // The unknown that the equation leaves most open.
    std::size_t pivot = n;
    double most = 0.0, total = 0.0;
    for (std::size_t v = 0; v < n; ++v) {
      const double part = std::abs(row(at(v))) * width_of(box[v]);
      total += part;
      if (used[v] || part <= most) continue;
      most = part;
      pivot = v;
    }
    if (pivot == n || most <= kNoise * total) continue;
    used[pivot] = true;
    for (std::size_t j = 0; j < m; ++j) {
      double& entry = middle_(at(j), at(pivot));
      if (j == k || (j < k && bend_[order_[k]] > kStraight) || entry == 0.0) continue;
      const double factor = entry / row(at(pivot));
      middle_.row(at(j)) -= factor * row;
      entry = 0.0;
      combination_.row(at(j)) -= factor * combination_.row(at(k));
    }
  }
}

// Forward and backward through the sum of a combination's terms.
bool Elimination::contract_by(const MeanValueForms::Form& form, std::vector<Interval>& box) {
  const auto& [value, slopes] = form;
  const std::size_t n = box.size();
  if (!value.is_bounded()) return true;
  terms_.resize(n);
  sums_.resize(n + 1);
  sums_[0] = value;
  for (std::size_t v = 0; v < n; ++v) {
    terms_[v] = up::mul(slopes[v], up::sub(box[v], forms_.center(v)));
    sums_[v + 1] = up::add(sums_[v], terms_[v]);
  }
  if (!sums_[n].contains(0.0)) return false;
  Interval rest = Interval::raw(0.0, 0.0);  // what the terms from here on have to make up
  for (std::size_t v = n; v-- > 0;) {
    const Interval term = meet(terms_[v], up::sub(rest, sums_[v]));
    if (term.is_empty()) return false;
    if (!(term == terms_[v])) {
      const Interval offset = up::mul_rev(slopes[v], term, up::sub(box[v], forms_.center(v)));
      box[v] = meet(box[v], up::add(forms_.center(v), offset));
      if (box[v].is_empty()) return false;
    }
    rest = up::sub(rest, terms_[v]);
  }
  return true;
}

}  // namespace hcsp
