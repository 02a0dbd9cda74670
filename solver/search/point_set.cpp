// SPDX-License-Identifier: Apache-2.0
#include "solver/search/point_set.h"

#include <algorithm>
#include <cmath>

#include "domains/check.h"

namespace hcsp {

std::uint32_t PointSet::place_of(const Input& input) const {
  const auto place = std::find_if(unknowns.begin(), unknowns.end(),
                                  [&](const System::Unknown& unknown) { return unknown.input == input; });
  HCSP_ASSERT(place != unknowns.end());
  return static_cast<std::uint32_t>(place - unknowns.begin());
}

Narrowing::Narrowing(const PointSet& set, NodeId relation)
    : set_(set), program_(set.dag, {relation}), formula_(set.dag, relation, program_) {
  for (const Input& input : program_.inputs()) places_.push_back(set.place_of(input));
}

bool Narrowing::contract(std::span<Interval> box) {
  values_.clear();
  for (const std::uint32_t v : places_) values_.push_back(box[v]);
  if (!formula_.contract(values_)) return false;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    Interval& domain = box[places_[i]];
    domain = meet(domain, values_[i]);
    if (set_.unknowns[places_[i]].is_whole) domain = whole_numbers_of(domain);
    if (domain.is_empty()) return false;
  }
  return true;
}

Interval whole_numbers_of(const Interval& x) {
  const Interval whole = Interval::raw(std::ceil(x.lo()), std::floor(x.hi()));
  return whole.is_empty() ? Interval::empty() : whole;
}

double cut_of(const Interval& x) {
  constexpr double kFar = 1e8, kFarther = 1e3;
  if (x.is_bounded()) return 0.5 * x.lo() + 0.5 * x.hi();
  if (x.is_entire()) return 0.0;
  if (x.lo() == -kInfinity) return -cut_of(-x);
  return std::min(std::max(kFar, kFarther * x.lo()), std::numeric_limits<double>::max());
}

bool cut_across(const PointSet& set, std::span<const Interval> box, std::uint32_t unknown, double cut,
                std::vector<Interval>& parts) {
  const Interval& side = box[unknown];
  const bool is_whole = set.unknowns[unknown].is_whole;
  constexpr double kExact = 0x1p53;
  if (is_whole) cut = std::clamp(std::floor(cut), -kExact, kExact - 1.0);
  const double next = is_whole ? cut + 1.0 : cut;
  if (is_whole ? !(side.lo() <= cut && next <= side.hi() && are_next(cut, next))
               : !(side.lo() < cut && cut < side.hi()))
    return false;
  const std::size_t size = box.size(), first = parts.size();
  parts.resize(first + 2 * size);
  Interval *low = &parts[first], *high = low + size;
  for (std::size_t v = 0; v < size; ++v) low[v] = high[v] = box[v];
  low[unknown] = Interval::raw(side.lo(), cut);
  high[unknown] = Interval::raw(next, side.hi());
  return true;
}

}  // namespace hcsp
