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

  /// Takes other intervals, as many, the i-th of them value_of(i): the durations, the instants, then
  /// component by component the coefficients phase by phase and the gates. Allocates nothing.
  template <class ValueOf>
  void assign(ValueOf value_of) {
    bool is_empty = false;
    const auto put = [&, all = all_.data()](std::size_t i, const Interval& value) {
      all[i] = value;
      is_empty |= value.is_empty();
    };
    for (std::size_t i = 0; i < phases_; ++i) put(i, meet(value_of(i), Interval::raw(0.0, kInfinity)));
    for (std::size_t i = phases_, size = all_.size(); i < size; ++i) put(i, value_of(i));
    is_empty_ = is_empty;
  }

  [[nodiscard]] std::size_t dim() const { return starts_.size() / (phases_ + 1); }
  [[nodiscard]] std::size_t phases() const { return phases_; }
  [[nodiscard]] bool is_empty() const { return is_empty_; }
  [[nodiscard]] const Interval& duration(std::size_t phase) const { return all_[phase]; }
  [[nodiscard]] const Interval& instant(std::size_t gate) const { return all_[phases_ + gate]; }
  [[nodiscard]] std::span<const Interval> coefficients(std::size_t c, std::size_t phase) const {
    const std::size_t place = c * (phases_ + 1) + phase;
    return std::span(all_).subspan(starts_[place], starts_[place + 1] - starts_[place]);
  }
  [[nodiscard]] std::size_t degree() const;

  [[nodiscard]] const Interval& gate(std::size_t c, std::size_t gate) const {
    return all_[starts_[c * (phases_ + 1) + phases_] + gate];
  }
  /// An enclosure of the values during a phase, its ends included.
  [[nodiscard]] Interval slice(std::size_t c, std::size_t phase) const;
  /// An enclosure of the values at the instants of an interval; empty where none is on the time line.
  [[nodiscard]] Interval at(std::size_t c, const Interval& instants) const;

  friend bool operator==(const PolynomialTube&, const PolynomialTube&) = default;

 private:
  friend PolynomialTube bottom(PolynomialTube tube);
  [[nodiscard]] Interval values(std::size_t c, std::size_t phase, const Interval& local_times) const;

  std::size_t phases_;
  std::vector<Interval> all_;        // in the order of assign()
  std::vector<std::size_t> starts_;  // by component and phase, of the coefficients; then of the gates
  bool is_empty_ = false;
};

PolynomialTube bottom(PolynomialTube tube);
/// Whether all that is known of `a` lies within what is known of `b`, a tube of the same shape
/// (std::invalid_argument otherwise).
bool leq(const PolynomialTube& a, const PolynomialTube& b);
/// The mean over the gates of the widest component.
double measure(const PolynomialTube& tube);

}  // namespace hcsp
