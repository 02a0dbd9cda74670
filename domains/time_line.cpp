// SPDX-License-Identifier: Apache-2.0
#include "domains/time_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "domains/check.h"
#include "domains/rounding.h"

namespace hcsp {

namespace {

// A decimal p / 10^q whose nearest double is a given one. The shortest such decimal is what a person wrote.
struct Decimal {
  double numerator;
  double denominator;
};

Decimal shortest_decimal(double x) {
  const std::string shortest = fmt::format("{}", x);
  const std::size_t point = shortest.find('.');
  const bool plain = shortest.find('e') == std::string::npos;
  if (!plain || shortest.size() > 16) return {x, 1.0};
  std::string digits = shortest;
  std::size_t places = 0;
  if (point != std::string::npos) {
    places = shortest.size() - point - 1;
    digits.erase(point, 1);
  }
  double numerator = 0.0;
  std::from_chars(digits.data(), digits.data() + digits.size(), numerator);
  return {numerator, std::pow(10.0, static_cast<double>(places))};
}

// The grid without further instants. k p / q is one correctly rounded division while k p is an integer below
// 2^53.
std::vector<double> plain_grid(double start, double end, double step) {
  const Decimal decimal = shortest_decimal(step);
  std::vector<double> instants;
  for (std::size_t k = 0;; ++k) {
    const double t = start + static_cast<double>(k) * decimal.numerator / decimal.denominator;
    if (t >= end) break;
    instants.push_back(t);
  }
  instants.push_back(end);
  return instants;
}

}  // namespace

TimeLine::TimeLine(std::vector<double> instants) : instants_(std::move(instants)) {
  require(instants_.size() >= 2, "TimeLine: {} instants given, two are needed", instants_.size());
  for (std::size_t i = 0; i < instants_.size(); ++i) {
    require(std::isfinite(instants_[i]), "TimeLine: instant {} is not finite", i);
    require(i == 0 || instants_[i - 1] < instants_[i], "TimeLine: instants {} and {} do not increase", i - 1,
            i);
  }
}

TimeLine TimeLine::grid(double start, double end, double step, const std::vector<double>& further) {
  require(std::isfinite(start) && std::isfinite(end) && start < end, "TimeLine: [{}, {}] is no span of time",
          start, end);
  require(std::isfinite(step) && step > 0, "TimeLine: the step {} is not positive", step);
  require((end - start) / step <= kMostInstants, "TimeLine: [{}, {}] has too many steps of {}", start, end,
          step);
  RoundNearest guard;
  std::vector<double> given;
  for (const double t : further) {
    if (start <= t && t <= end) given.push_back(t);
  }
  given.push_back(start);
  given.push_back(end);
  std::sort(given.begin(), given.end());
  given.erase(std::unique(given.begin(), given.end()), given.end());
  std::vector<double> instants = given;
  for (const double t : plain_grid(start, end, step)) {
    const auto after = std::lower_bound(given.begin(), given.end(), t);
    const bool near_after = after != given.end() && *after - t < 1e-6 * step;
    const bool near_before = after != given.begin() && t - *std::prev(after) < 1e-6 * step;
    if (!near_after && !near_before) instants.push_back(t);
  }
  std::sort(instants.begin(), instants.end());
  return TimeLine(std::move(instants));
}

Interval TimeLine::span(std::size_t item) const {
  return Interval::raw(instants_[item / 2], instants_[(item + 1) / 2]);
}

std::optional<std::size_t> TimeLine::gate_at(double t) const {
  const auto found = std::lower_bound(instants_.begin(), instants_.end(), t);
  if (found == instants_.end() || *found != t) return std::nullopt;
  return static_cast<std::size_t>(found - instants_.begin());
}

ItemSet ItemSet::all(std::size_t items) {
  ItemSet set;
  set.words_.assign((items + 63) / 64, ~std::uint64_t{0});
  if (items % 64 != 0) set.words_.back() = (std::uint64_t{1} << (items % 64)) - 1;
  return set;
}

ItemSet ItemSet::range(std::size_t first, std::size_t last) {
  ItemSet set = all(last + 1);
  for (std::size_t w = 0; w < first / 64; ++w) set.words_[w] = 0;
  set.words_[first / 64] &= ~std::uint64_t{0} << (first % 64);
  return set;
}

bool ItemSet::is_none() const {
  return std::all_of(words_.begin(), words_.end(), [](std::uint64_t word) { return word == 0; });
}

void ItemSet::insert(std::size_t item) {
  if (item / 64 >= words_.size()) words_.resize(item / 64 + 1, 0);
  words_[item / 64] |= std::uint64_t{1} << (item % 64);
}

void ItemSet::join(const ItemSet& other) {
  if (words_.size() < other.words_.size()) words_.resize(other.words_.size(), 0);
  for (std::size_t w = 0; w < other.words_.size(); ++w) words_[w] |= other.words_[w];
}

void ItemSet::meet(const ItemSet& other) {
  words_.resize(std::min(words_.size(), other.words_.size()));
  for (std::size_t w = 0; w < words_.size(); ++w) words_[w] &= other.words_[w];
}

}  // namespace hcsp
