// SPDX-License-Identifier: Apache-2.0
#include "domains/polynomial_tube.h"

#include <algorithm>

#include "domains/check.h"

namespace hcsp {

namespace {

// Horner's scheme, of the derivative of some order: the same coefficients, moved.
Interval evaluated(std::span<const Interval> coefficients, std::size_t order, const Interval& s) {
  Interval value = coefficients.back();
  for (std::size_t k = coefficients.size() - 1; k > order; --k)
    value = coefficients[k - 1] + s / Interval(static_cast<double>(k - order)) * value;
  return value;
}

// The range over an interval: where the slope has one sign its ends tell it; elsewhere the mean value theorem
// does, and halves of it.
Interval range(std::span<const Interval> coefficients, const Interval& s, int halvings) {
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
    : phases_(durations.size()), all_(std::move(durations)) {
  require(phases_ > 0 && instants.size() == phases_ + 1, "PolynomialTube: {} durations and {} instants",
          phases_, instants.size());
  const auto add = [&](const std::vector<Interval>& part) {
    all_.insert(all_.end(), part.begin(), part.end());
  };
  add(instants);
  for (const Component& component : components) {
    require(component.coefficients.size() == phases_ && component.gates.size() == instants.size(),
            "PolynomialTube: a component of {} phases and {} gates", component.coefficients.size(),
            component.gates.size());
    for (const auto& of_phase : component.coefficients) {
      require(!of_phase.empty(), "PolynomialTube: a polynomial without coefficients");
      starts_.push_back(all_.size());
      add(of_phase);
    }
    starts_.push_back(all_.size());
    add(component.gates);
  }
  assign([&](std::size_t i) { return all_[i]; });
}

std::size_t PolynomialTube::degree() const {
  std::size_t highest = 0;
  for (std::size_t c = 0; c < dim(); ++c) {
    for (std::size_t i = 0; i < phases_; ++i) highest = std::max(highest, coefficients(c, i).size() - 1);
  }
  return highest;
}

Interval PolynomialTube::values(std::size_t c, std::size_t phase, const Interval& local_times) const {
  constexpr int kHalvings = 5;
  return range(coefficients(c, phase), local_times, kHalvings);
}

Interval PolynomialTube::slice(std::size_t c, std::size_t phase) const {
  if (is_empty_) return Interval::empty();
  return values(c, phase, Interval(0.0, duration(phase).hi()));
}

// In which phase an instant lies is not known where gates are not.
Interval PolynomialTube::at(std::size_t c, const Interval& instants) const {
  Interval all = Interval::empty();
  if (is_empty_) return all;
  for (std::size_t i = 0; i < phases(); ++i) {
    if (meet(instants, join(instant(i), instant(i + 1))).is_empty()) continue;
    const Interval local = meet(instants - instant(i), Interval(0.0, duration(i).hi()));
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
      const auto p = a.coefficients(c, k), q = b.coefficients(c, k);
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
