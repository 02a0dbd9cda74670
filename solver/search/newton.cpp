// SPDX-License-Identifier: Apache-2.0
#include "solver/search/newton.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "domains/interval/kernel.h"

namespace hcsp {

namespace {

constexpr Interval kZero = Interval::raw(0.0, 0.0);

double middle_of(const Interval& x) { return 0.5 * x.lo() + 0.5 * x.hi(); }

bool is_bounded(const std::vector<Interval>& box) {
  return std::all_of(box.begin(), box.end(), [](const Interval& x) { return x.is_bounded(); });
}

}  // namespace

Newton::Newton(const System& system) : system_(system), run_(*system.tape), smear_(system.unknowns.size()) {
  for (std::uint32_t i = 0; i < system.relations.size(); ++i) {
    if (system.relations[i].is_equation()) equations_.push_back(i);
  }
  const std::size_t n = system.unknowns.size();
  jacobian_.assign(equations_.size(), std::vector<Interval>(n, kZero));
  values_.resize(equations_.size());
  for (auto* box : {&reach_, &image_, &center_, &row_}) box->resize(n);
  rows_.resize(std::min(n, equations_.size()));
  columns_.resize(rows_.size());
  std::iota(rows_.begin(), rows_.end(), 0U);
  std::iota(columns_.begin(), columns_.end(), 0U);
}

// False where the mean value theorem does not hold. A slope that is nowhere defined, like that of a root at
// 0, is empty.
bool Newton::evaluate_jacobian(const std::vector<Interval>& box) {
  run_.evaluate(box, true);
  bool is_continuous = true;
  for (std::size_t e = 0; e < equations_.size(); ++e) {
    run_.gradient(equations_[e], jacobian_[e]);
    is_continuous = is_continuous && run_.is_continuous(equations_[e]) &&
                    std::all_of(jacobian_[e].begin(), jacobian_[e].end(), [](const Interval& slope) {
                      return slope.is_bounded() && !slope.is_empty();
                    });
  }
  return is_continuous;
}

const std::vector<double>& Newton::smear(const std::vector<Interval>& box) {
  evaluate_jacobian(box);
  std::fill(smear_.begin(), smear_.end(), 0.0);
  for (std::size_t e = 0; e < equations_.size(); ++e) {
    const auto variables = system_.tape->variables(equations_[e]);
    const auto part = [&](std::uint32_t v) {
      constexpr double kMost = 1e100;
      const double slope = jacobian_[e][v].mag();
      return slope == 0.0 ? 0.0 : std::min(slope * (box[v].hi() - box[v].lo()), kMost);
    };
    double total = 0.0;
    for (const std::uint32_t v : variables) total += part(v);
    if (total == 0.0) continue;
    for (const std::uint32_t v : variables) smear_[v] += part(v) / total;
  }
  return smear_;
}

// As many equations as unknowns: those that Gauss's elimination of the midpoint pivots on. A whole number
// that is known is none of them.
bool Newton::choose_square(const std::vector<Interval>& box) {
  const std::size_t m = equations_.size(), n = system_.unknowns.size(), size = rows_.size();
  Eigen::MatrixXd middle(static_cast<Eigen::Index>(m), static_cast<Eigen::Index>(n));
  for (Eigen::Index e = 0; e < middle.rows(); ++e) {
    for (std::size_t v = 0; v < n; ++v) {
      const bool is_known = system_.is_whole[v] != 0 && box[v].is_point();
      middle(e, static_cast<Eigen::Index>(v)) =
          is_known ? 0.0 : middle_of(jacobian_[static_cast<std::size_t>(e)][v]);
    }
  }
  const Eigen::FullPivLU<Eigen::MatrixXd> lu(middle);
  if (static_cast<std::size_t>(lu.rank()) < size) return false;
  const auto& place_of_row = lu.permutationP().indices();
  for (std::size_t e = 0; e < m; ++e) {
    const auto place = static_cast<std::size_t>(place_of_row[static_cast<Eigen::Index>(e)]);
    if (place < size) rows_[place] = static_cast<std::uint32_t>(e);
  }
  for (std::size_t k = 0; k < size; ++k)
    columns_[k] = static_cast<std::uint32_t>(lu.permutationQ().indices()[static_cast<Eigen::Index>(k)]);
  return true;
}

bool Newton::precondition() {
  const auto size = static_cast<Eigen::Index>(rows_.size());
  Eigen::MatrixXd middle(size, size);
  for (Eigen::Index e = 0; e < size; ++e) {
    const auto& row = jacobian_[rows_[static_cast<std::size_t>(e)]];
    for (Eigen::Index v = 0; v < size; ++v)
      middle(e, v) = middle_of(row[columns_[static_cast<std::size_t>(v)]]);
  }
  inverse_ = Eigen::PartialPivLU<Eigen::MatrixXd>(middle).inverse();
  return inverse_.allFinite();
}

// One step on a box; the image is met with it.
Newton::Outcome Newton::step(const std::vector<Interval>& box, std::vector<Interval>& image) {
  const std::size_t n = box.size(), size = rows_.size();
  if (!evaluate_jacobian(box) || !precondition()) return Outcome::nothing;
  for (std::size_t v = 0; v < n; ++v) {
    const double middle = middle_of(box[v]);
    center_[v] = Interval::raw(middle, middle);
  }
  run_.evaluate(center_, false);
  for (std::size_t e = 0; e < equations_.size(); ++e)
    values_[e] = up::sub(run_.value(equations_[e]), system_.relations[equations_[e]].wanted);
  image = box;
  bool is_inside = true;
  for (std::size_t k = 0; k < size; ++k) {
    // Row k of the inverse, times the values and the Jacobian.
    const std::uint32_t v = columns_[k];
    Interval value = kZero;
    std::fill(row_.begin(), row_.end(), kZero);
    for (std::size_t e = 0; e < size; ++e) {
      const double entry = inverse_(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(e));
      if (entry == 0.0) continue;
      const Interval factor = Interval::raw(entry, entry);
      value = up::add(value, up::mul(factor, values_[rows_[e]]));
      for (const std::uint32_t u : system_.tape->variables(equations_[rows_[e]]))
        row_[u] = up::add(row_[u], up::mul(factor, jacobian_[rows_[e]][u]));
    }
    for (std::size_t u = 0; u < n; ++u) {
      if (u != v) value = up::add(value, up::mul(row_[u], up::sub(image[u], center_[u])));
    }
    Interval part;
    if (row_[v].contains(0.0)) {
      is_inside = false;
      part = up::add(center_[v], up::mul_rev(row_[v], -value, up::sub(image[v], center_[v])));
    } else {
      part = up::add(center_[v], up::div(-value, row_[v]));
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
    const double margin = kWider * (box[v].hi() - box[v].lo()) + kLeast * std::max(box[v].mag(), kNearZero);
    reach_[v] = system_.is_whole[v] != 0 ? box[v] : up::add(box[v], Interval::raw(-margin, margin));
  }
  if (equations_.size() != box.size() && (!evaluate_jacobian(reach_) || !choose_square(box)))
    return Outcome::nothing;
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

// The unknowns that are solved for get room; how much they need depends on how the parameters move them.
bool Newton::prove_some(const std::vector<Interval>& box) {
  if (rows_.empty() || !is_bounded(box) || !evaluate_jacobian(box) || !choose_square(box)) return false;
  double widest = 0.0;
  for (const Interval& side : box) widest = std::max(widest, side.hi() - side.lo());
  for (const double room : {0.1, 0.5, 2.0}) {
    reach_ = box;
    for (const std::uint32_t v : columns_) {
      if (system_.is_whole[v] == 0) reach_[v] = up::add(box[v], Interval::raw(-room * widest, room * widest));
    }
    if (step(reach_, image_) == Outcome::proven) return true;
  }
  return false;
}

bool Newton::is_one() const {
  for (std::uint32_t v = 0; v < reach_.size(); ++v) {
    if (!reach_[v].is_point() && std::find(columns_.begin(), columns_.end(), v) == columns_.end())
      return false;
  }
  return true;
}

// Further steps on the enclosure of the one solution in reach(), while they sharpen it.
void Newton::polish() {
  constexpr int kMostSteps = 10;
  std::vector<Interval> next(image_.size());
  for (int k = 0; k < kMostSteps; ++k) {
    const Outcome outcome = step(image_, next);
    if (outcome == Outcome::nothing || outcome == Outcome::empty || next == image_) return;
    image_.swap(next);
  }
}

}  // namespace hcsp
