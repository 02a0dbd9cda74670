// SPDX-License-Identifier: Apache-2.0
#include "solver/search/newton.h"

#include <Eigen/LU>
#include <algorithm>
#include <numeric>

#include "domains/interval/kernel.h"
#include "domains/rounding.h"
#include "solver/search/implied_equations.h"

namespace hcsp {

Newton::Newton(const System& system, MeanValueForms& forms)
    : system_(system), forms_(forms), reach_(system.size()), image_(system.size()) {
  const RoundUpward guard;
  const std::vector<std::uint8_t> implied = implied_equations(system);
  for (std::uint32_t e = 0; e < forms.size(); ++e) {
    if (implied[e] == 0) needed_.push_back(e);
  }
  rows_ = needed_;
  rows_.resize(std::min(needed_.size(), system.size()));
  columns_.resize(rows_.size());
  std::iota(columns_.begin(), columns_.end(), 0U);
}

// False where the mean value theorem does not hold of every equation.
bool Newton::expand_over(const std::vector<Interval>& box) {
  forms_.expand_over(box);
  return std::all_of(needed_.begin(), needed_.end(), [&](std::uint32_t e) { return forms_.has_form(e); });
}

// As many equations as unknowns: those that Gauss's elimination of the midpoint pivots on. A whole number
// that is known is none of them, nor is what is given.
bool Newton::choose_square(const std::vector<Interval>& box) {
  const std::size_t m = needed_.size(), n = box.size(), size = rows_.size();
  Eigen::MatrixXd middle(static_cast<Eigen::Index>(m), static_cast<Eigen::Index>(n));
  for (Eigen::Index e = 0; e < middle.rows(); ++e) {
    for (std::size_t v = 0; v < n; ++v) {
      const bool is_known = system_.is_given[v] != 0 || (system_.is_whole[v] != 0 && box[v].is_point());
      middle(e, static_cast<Eigen::Index>(v)) =
          is_known ? 0.0 : middle_of(forms_.slopes(needed_[static_cast<std::size_t>(e)])[v]);
    }
  }
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(middle);
  if (static_cast<std::size_t>(lu.rank()) < size) return false;
  const auto& place_of_row = lu.permutationP().indices();
  for (std::size_t e = 0; e < m; ++e) {
    const auto place = static_cast<std::size_t>(place_of_row[static_cast<Eigen::Index>(e)]);
    if (place < size) rows_[place] = needed_[e];
  }
  for (std::size_t k = 0; k < size; ++k)
    columns_[k] = static_cast<std::uint32_t>(lu.permutationQ().indices()[static_cast<Eigen::Index>(k)]);
  return true;
}

bool Newton::precondition() {
  const auto size = static_cast<Eigen::Index>(rows_.size());
  Eigen::MatrixXd middle(size, size);
  for (Eigen::Index e = 0; e < size; ++e) {
    const auto& row = forms_.slopes(rows_[static_cast<std::size_t>(e)]);
    for (Eigen::Index v = 0; v < size; ++v)
      middle(e, v) = middle_of(row[columns_[static_cast<std::size_t>(v)]]);
  }
  inverse_ = Eigen::PartialPivLU<Eigen::MatrixXd>(middle).inverse();
  return inverse_.allFinite();
}

// One step on a box; the image is met with it.
Newton::Outcome Newton::step(const std::vector<Interval>& box, std::vector<Interval>& image) {
  const std::size_t n = box.size(), size = rows_.size();
  if (!is_bounded(box)) return Outcome::nothing;
  forms_.expand_over(box);
  const auto has_form = [&](std::uint32_t e) { return forms_.has_form(e); };
  if (!std::all_of(rows_.begin(), rows_.end(), has_form) || !precondition()) return Outcome::nothing;
  forms_.evaluate_at_center();
  image = box;
  bool is_inside = true;
  for (std::size_t k = 0; k < size; ++k) {
    const std::uint32_t v = columns_[k];
    const auto factors = inverse_.row(static_cast<Eigen::Index>(k));
    const auto& [at_center, slopes] = forms_.combine(rows_, {factors.data(), size});
    Interval value = at_center;
    for (std::size_t u = 0; u < n; ++u) {
      if (u != v) value = up::add(value, up::mul(slopes[u], up::sub(image[u], forms_.center(u))));
    }
    const Interval& center = forms_.center(v);
    Interval part;
    if (slopes[v].contains(0.0)) {
      is_inside = false;
      part = up::add(center, up::mul_rev(slopes[v], -value, up::sub(image[v], center)));
    } else {
      part = up::add(center, up::div(-value, slopes[v]));
      is_inside = is_inside && part.lo() > box[v].lo() && part.hi() < box[v].hi();
    }
    image[v] = meet(image[v], part);
    if (image[v].is_empty()) return Outcome::empty;
  }
  return is_inside ? Outcome::proven : Outcome::contracted;
}

Newton::Outcome Newton::contract(std::vector<Interval>& box) {
  if (rows_.empty() || !is_bounded(box)) return Outcome::nothing;
  // A solution on the box's face would not be inside.
  for (std::size_t v = 0; v < box.size(); ++v) {
    constexpr double kWider = 0.05, kLeast = 1e-13, kNearZero = 1e-3;
    const double margin = kWider * width_of(box[v]) + kLeast * std::max(box[v].mag(), kNearZero);
    reach_[v] = system_.is_whole[v] != 0 ? box[v] : up::add(box[v], Interval::raw(-margin, margin));
  }
  if (needed_.size() != box.size() && (!expand_over(reach_) || !choose_square(box))) return Outcome::nothing;
  const Outcome outcome = step(reach_, image_);
  if (outcome == Outcome::nothing || outcome == Outcome::empty) return outcome;
  bool changed = false;
  for (std::size_t v = 0; v < box.size(); ++v) {
    const Interval met = meet(box[v], image_[v]);
    if (met.is_empty()) return Outcome::empty;
    changed = changed || !(met == box[v]);
    box[v] = met;
  }
  if (outcome != Outcome::proven) return changed ? Outcome::contracted : Outcome::nothing;
  if (is_one()) polish();
  return outcome;
}

// A box of rounding errors' width is too narrow for the image of its surroundings to lie in it: it is given
// more and more room (epsilon inflation, Rump 1999).
bool Newton::prove_alone(const std::vector<Interval>& box, double farthest) {
  constexpr double kFirst = 1e-12, kMore = 16.0, kNearZero = 1e-3;
  if (needed_.size() != box.size() || !is_bounded(box)) return false;
  for (double room = kFirst; room <= farthest; room *= kMore) {
    for (std::size_t v = 0; v < box.size(); ++v) {
      const double margin = room * std::max(box[v].mag(), kNearZero) + width_of(box[v]);
      reach_[v] = system_.is_whole[v] != 0 ? box[v] : up::add(box[v], Interval::raw(-margin, margin));
    }
    const Outcome outcome = step(reach_, image_);
    if (outcome == Outcome::nothing) return false;
    if (outcome == Outcome::proven) {
      polish();
      return true;
    }
  }
  return false;
}

// The unknowns that are solved for get room; how much they need depends on how the parameters move them.
bool Newton::prove_some(const std::vector<Interval>& box) {
  if (rows_.empty() || !is_bounded(box) || !expand_over(box) || !choose_square(box)) return false;
  double widest = 0.0;
  for (const Interval& side : box) widest = std::max(widest, width_of(side));
  for (const double room : {0.1, 0.25, 0.5, 1.0, 2.0}) {
    reach_ = box;
    for (const std::uint32_t v : columns_) {
      if (system_.is_whole[v] == 0) reach_[v] = up::add(box[v], Interval::raw(-room * widest, room * widest));
    }
    if (step(reach_, image_) == Outcome::proven) return true;
  }
  return false;
}

Newton::Outcome Newton::contract(std::vector<Interval>& box, std::span<const std::uint32_t> rows,
                                 std::span<const std::uint32_t> columns) {
  rows_.assign(rows.begin(), rows.end());
  columns_.assign(columns.begin(), columns.end());
  if (rows_.empty() || !is_bounded(box)) return Outcome::nothing;
  const Outcome outcome = step(box, image_);
  if (outcome == Outcome::contracted || outcome == Outcome::proven) box = image_;
  return outcome;
}

bool Newton::prove_in(const std::vector<Interval>& reach, std::span<const std::uint32_t> rows,
                      std::span<const std::uint32_t> solved) {
  rows_.assign(rows.begin(), rows.end());
  columns_.assign(solved.begin(), solved.end());
  reach_ = reach;
  if (step(reach_, image_) != Outcome::proven) return false;
  polish();
  return true;
}

bool Newton::is_one() const {
  const auto is_point = [](const Interval& x) { return x.is_point(); };
  const auto points = static_cast<std::size_t>(std::count_if(reach_.begin(), reach_.end(), is_point));
  const auto solved = static_cast<std::size_t>(
      std::count_if(columns_.begin(), columns_.end(), [&](auto v) { return !reach_[v].is_point(); }));
  return points + solved == reach_.size();
}

// Further steps on the enclosure of the one solution in reach(), while they sharpen it.
void Newton::polish() {
  constexpr int kMostSteps = 10;
  for (int k = 0; k < kMostSteps; ++k) {
    const Outcome outcome = step(image_, next_);
    if (outcome == Outcome::nothing || outcome == Outcome::empty || next_ == image_) return;
    image_.swap(next_);
  }
}

}  // namespace hcsp
