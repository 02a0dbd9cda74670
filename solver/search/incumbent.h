// SPDX-License-Identifier: Apache-2.0
// The best feasible point that the threads of a search know.
#pragma once

#include <atomic>
#include <mutex>
#include <vector>

#include "domains/interval/interval.h"

namespace hcsp {

class Incumbent {
 public:
  /// An upper bound of the objective there; oo as long as none is known.
  [[nodiscard]] double value() const { return value_.load(std::memory_order_relaxed); }
  void offer(double value, const std::vector<Interval>& box) {
    if (!(value < this->value())) return;
    const std::lock_guard lock(mutex_);
    if (!(value < this->value())) return;
    box_ = box;
    value_.store(value, std::memory_order_relaxed);
  }
  /// Holds the point. Not while others offer().
  [[nodiscard]] const std::vector<Interval>& box() const { return box_; }

 private:
  std::atomic<double> value_ = kInfinity;
  std::mutex mutex_;
  std::vector<Interval> box_;
};

}  // namespace hcsp
