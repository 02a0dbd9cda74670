// SPDX-License-Identifier: Apache-2.0
// Tubes on a time line with phases, as results tell them: on each phase a polynomial in local time, whose
// coefficients are known within intervals, as are the durations of the phases. What it encloses: every
// function that is such a polynomial on each phase for some values in the intervals.
#pragma once

#include <span>
#include <vector>

#include "domains/interval/interval.h"

namespace hcsp {

class PolynomialTube {
 public:
  /// A component: by phase the coefficients of s^k/k!, s the time since the phase began; by gate the value.
  struct Component {
    std::vector<std::vector<Interval>> coefficients;
    std::vector<Interval> gates;
    friend bool operator==(const Component&, const Component&) = default;
  };

  /// `instants` are the gates' times, one more than durations. An empty interval anywhere empties the tube.
  PolynomialTube(std::vector<Interval> durations, std::vector<Interval> instants,
                 std::vector<Component> components);

  /// Takes other intervals, as many: the durations, the instants, then component by component the
  /// coefficients phase by phase and the gates. Allocates nothing.
  void assign(std::span<const Interval> values);

  [[nodiscard]] std::size_t dim() const { return components_.size(); }
  [[nodiscard]] std::size_t phases() const { return durations_.size(); }
  [[nodiscard]] bool is_empty() const { return is_empty_; }
  [[nodiscard]] const Interval& duration(std::size_t phase) const { return durations_[phase]; }
  [[nodiscard]] const Interval& instant(std::size_t gate) const { return instants_[gate]; }
  [[nodiscard]] const std::vector<Interval>& coefficients(std::size_t c, std::size_t phase) const {
    return components_[c].coefficients[phase];
  }
  [[nodiscard]] std::size_t degree() const;

  [[nodiscard]] const Interval& gate(std::size_t c, std::size_t gate) const {
    return components_[c].gates[gate];
  }
  /// An enclosure of the values during a phase, its ends included.
  [[nodiscard]] Interval slice(std::size_t c, std::size_t phase) const;
  /// An enclosure of the values at the instants of an interval; empty where none is on the time line.
  [[nodiscard]] Interval at(std::size_t c, const Interval& instants) const;

  friend bool operator==(const PolynomialTube&, const PolynomialTube&) = default;

 private:
  friend PolynomialTube bottom(PolynomialTube tube);
  void find_emptiness();
  [[nodiscard]] Interval values(std::size_t c, std::size_t phase, const Interval& local_times) const;

  std::vector<Interval> durations_, instants_;
  std::vector<Component> components_;
  bool is_empty_ = false;
};

PolynomialTube bottom(PolynomialTube tube);
/// Whether all that is known of `a` lies within what is known of `b`, a tube of the same shape
/// (std::invalid_argument otherwise).
bool leq(const PolynomialTube& a, const PolynomialTube& b);
/// The mean over the gates of the widest component.
double measure(const PolynomialTube& tube);

}  // namespace hcsp
