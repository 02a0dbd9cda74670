// SPDX-License-Identifier: Apache-2.0
// Where the simulated robot really was: its speed and heading are doubles that hold between stamps that are
// doubles, so x(t) is a sum of products of reals. It is computed with 320 bits; over a mission the errors add
// up to less than 2^-250 m, which the comparisons below allow for. No other slack: a bound is either met or
// not.
#pragma once

#include <mpfr.h>

#include <memory>
#include <vector>

#include "domains/interval/interval.h"
#include "examples/slam_simulator.h"

namespace hcsp::soundness {

/// A real number, known to within 2^-250.
class ExactReal {
 public:
  ExactReal() {
    mpfr_init2(value_, kBits);
    mpfr_set_zero(value_, 1);
  }
  ExactReal(const ExactReal& other) : ExactReal() { mpfr_set(value_, other.value_, MPFR_RNDN); }
  ExactReal& operator=(const ExactReal& other) {
    mpfr_set(value_, other.value_, MPFR_RNDN);
    return *this;
  }
  ~ExactReal() { mpfr_clear(value_); }

  /// This + speed cos(heading) (to - from), or sin.
  [[nodiscard]] ExactReal moved(double speed, double heading, bool sine, double from, double to) const;
  /// Whether the number lies within the interval.
  [[nodiscard]] bool in(const Interval& bound) const;
  /// A few units in the last place around it.
  [[nodiscard]] Interval enclosure() const;

 private:
  static constexpr mpfr_prec_t kBits = 320;
  mpfr_t value_;
};

class ExactTruth {
 public:
  explicit ExactTruth(const slam_simulator::Trajectory& path);
  /// Component c at the time of stamp k.
  [[nodiscard]] const ExactReal& at_stamp(int c, std::size_t k) const {
    return x_[static_cast<std::size_t>(c)][k];
  }
  /// Component c at a time between the stamps k and k + 1.
  [[nodiscard]] ExactReal at(int c, std::size_t k, double time) const;

 private:
  slam_simulator::Trajectory path_;
  std::vector<ExactReal> x_[2];
};

/// The distance from the point to the nearest wall, enclosed.
Interval distance_to(const slam_simulator::Map& map, const Interval& x1, const Interval& x2);

}  // namespace hcsp::soundness
