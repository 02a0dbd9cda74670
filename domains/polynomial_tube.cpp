// SPDX-License-Identifier: Apache-2.0
#include "domains/polynomial_tube.h"

#include <algorithm>

#include "domains/check.h"

namespace hcsp {

namespace {

// Horner's scheme, of the derivative of some order: the same coefficients, moved.
Interval evaluated(const std::vector<Interval>& coefficients, std::size_t order, const Interval& s) {
  Interval value = coefficients.back();
  for (std::size_t k = coefficients.size() - 1; k > order; --k)
    value = coefficients[k - 1] + s / Interval(static_cast<double>(k - order)) * value;
  return value;
}

// The range over an interval: where the slope has one sign its ends tell it; elsewhere the mean value theorem
// does, and halves of it.
Interval range(const std::vector<Interval>& coefficients, const Interval& s, int halvings) {
  const Interval direct = evaluated(coefficients, 0, s);
  if (coefficients.size() == 1 || s.is_point() || !s.is_bounded()) return direct;
  const auto value_at = [&](double at) { return evaluated(coefficients, 0, Interval(at)); };
  const Interval slope = evaluated(coefficients, 1, s);
  if (slope.lo() >= 0.0 || slope.hi() <= 0.0) return meet(direct, join(value_at(s.lo()), value_at(s.hi())));
  const double middle = s.mid();
  const Interval all = meet(direct, value_at(middle) + slope * (s - Interval(middle)));
  if (halvings == 0 || !(s.lo() < middle && middle < s.hi())) return all;
  return meet(all, join(range(coefficients, Interval(s.lo(), middle), halvings - 1),
                        range(coefficients, Interval(middle, s.hi()), halvings - 1)));
}

}  // namespace

PolynomialTube::PolynomialTube(std::vector<Interval> durations, std::vector<Interval> instants,
                               std::vector<Component> components)
    : durations_(std::move(durations)), instants_(std::move(instants)), components_(std::move(components)) {
  require(!durations_.empty() && instants_.size() == durations_.size() + 1,
          "PolynomialTube: {} durations and {} instants", durations_.size(), instants_.size());
  for (const Component& component : components_) {
    require(component.coefficients.size() == phases() && component.gates.size() == instants_.size(),
            "PolynomialTube: a component of {} phases and {} gates", component.coefficients.size(),
            component.gates.size());
    for (const auto& of_phase : component.coefficients)
      require(!of_phase.empty(), "PolynomialTube: a polynomial without coefficients");
  }
  find_emptiness();
}

void PolynomialTube::find_emptiness() {
  const auto is_void = [](const std::vector<Interval>& all) {
    return std::any_of(all.begin(), all.end(), [](const Interval& x) { return x.is_empty(); });
  };
  for (Interval& duration : durations_) duration = meet(duration, Interval(0.0, kInfinity));
  is_empty_ = is_void(durations_) || is_void(instants_);
  for (const Component& component : components_) {
    is_empty_ = is_empty_ || is_void(component.gates) ||
                std::any_of(component.coefficients.begin(), component.coefficients.end(), is_void);
  }
}

void PolynomialTube::assign(std::span<const Interval> values) {
  const auto take = [&](std::vector<Interval>& part) {
    HCSP_ASSERT(values.size() >= part.size());
    std::copy_n(values.begin(), part.size(), part.begin());
    values = values.subspan(part.size());
  };
  take(durations_);
  take(instants_);
  for (Component& component : components_) {
    for (auto& of_phase : component.coefficients) take(of_phase);
    take(component.gates);
  }
  HCSP_ASSERT(values.empty());
  find_emptiness();
}

std::size_t PolynomialTube::degree() const {
  std::size_t highest = 0;
  for (const Component& component : components_) {
    for (const auto& of_phase : component.coefficients) highest = std::max(highest, of_phase.size() - 1);
  }
  return highest;
}

Interval PolynomialTube::values(std::size_t c, std::size_t phase, const Interval& local_times) const {
  constexpr int kHalvings = 5;
  return range(components_[c].coefficients[phase], local_times, kHalvings);
}

Interval PolynomialTube::slice(std::size_t c, std::size_t phase) const {
  if (is_empty_) return Interval::empty();
  return values(c, phase, Interval(0.0, durations_[phase].hi()));
}

// In which phase an instant lies is not known where gates are not.
Interval PolynomialTube::at(std::size_t c, const Interval& instants) const {
  Interval all = Interval::empty();
  if (is_empty_) return all;
  for (std::size_t i = 0; i < phases(); ++i) {
    if (meet(instants, join(instants_[i], instants_[i + 1])).is_empty()) continue;
    const Interval local = meet(instants - instants_[i], Interval(0.0, durations_[i].hi()));
    if (!local.is_empty()) all = join(all, values(c, i, local));
  }
  return all;
}

PolynomialTube bottom(PolynomialTube tube) {
  tube.is_empty_ = true;
  return tube;
}

bool leq(const PolynomialTube& a, const PolynomialTube& b) {
  require(a.dim() == b.dim() && a.phases() == b.phases(), "PolynomialTube: shapes differ");
  if (a.is_empty()) return true;
  if (b.is_empty()) return false;
  const auto lies_in = [](const Interval& x, const Interval& y) { return leq(x, y); };
  for (std::size_t k = 0; k <= a.phases(); ++k) {
    bool is_within =
        leq(a.instant(k), b.instant(k)) && (k == a.phases() || leq(a.duration(k), b.duration(k)));
    for (std::size_t c = 0; c < a.dim(); ++c) {
      is_within = is_within && leq(a.gate(c, k), b.gate(c, k));
      if (k == a.phases()) continue;
      const auto &p = a.coefficients(c, k), &q = b.coefficients(c, k);
      is_within = is_within && p.size() == q.size() && std::equal(p.begin(), p.end(), q.begin(), lies_in);
    }
    if (!is_within) return false;
  }
  return true;
}

double measure(const PolynomialTube& tube) {
  double sum = 0.0;
  for (std::size_t gate = 0; gate <= tube.phases(); ++gate) {
    double widest = 0.0;
    for (std::size_t c = 0; c < tube.dim(); ++c) widest = std::max(widest, tube.gate(c, gate).width());
    sum += widest;
  }
  return sum / static_cast<double>(tube.phases() + 1);
}

}  // namespace hcsp
