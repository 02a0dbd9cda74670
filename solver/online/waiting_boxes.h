// SPDX-License-Identifier: Apache-2.0
// The boxes of a search that are still to be looked at, of all cases, in a heap on room that is allocated
// once.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "domains/interval/interval.h"

namespace hcsp::online {

class WaitingBoxes {
 public:
  WaitingBoxes(std::size_t most, std::size_t longest)
      : longest_(longest), boxes_(most * longest), free_(most) {
    waiting_.reserve(most);
    std::iota(free_.begin(), free_.end(), 0U);
  }

  void clear() {
    waiting_.clear();
    std::iota(free_.begin(), free_.begin() + static_cast<std::ptrdiff_t>(used_), 0U);
    used_ = 0;
    count_ = 0;
  }
  [[nodiscard]] bool empty() const { return waiting_.empty(); }
  [[nodiscard]] bool has_room_for(std::size_t boxes) const { return waiting_.size() + boxes <= free_.size(); }
  /// The least lower bound of all. PRECONDITION: not empty.
  [[nodiscard]] double lower() const { return waiting_.front().lower; }

  /// PRECONDITION: there is room.
  void push(std::span<const Interval> box, std::uint32_t owner, double lower) {
    const std::uint32_t place = free_[waiting_.size()];
    std::copy(box.begin(), box.end(), at(place));
    waiting_.push_back({lower, count_++, place, owner});
    used_ = std::max(used_, waiting_.size());
    std::push_heap(waiting_.begin(), waiting_.end(), is_later);
  }
  /// Whose box comes next. PRECONDITION: not empty.
  [[nodiscard]] std::uint32_t owner() const { return waiting_.front().owner; }
  /// That box, and perhaps more behind it. PRECONDITION: not empty.
  [[nodiscard]] std::span<const Interval> box() const {
    return std::span(boxes_).subspan(waiting_.front().place * longest_, longest_);
  }
  /// Takes the box with the least lower bound, of equal ones the last that came. PRECONDITION: not empty.
  void pop(std::span<Interval> box) {
    std::pop_heap(waiting_.begin(), waiting_.end(), is_later);
    const std::uint32_t place = waiting_.back().place;
    waiting_.pop_back();
    free_[waiting_.size()] = place;
    std::copy_n(at(place), box.size(), box.begin());
  }

 private:
  struct Waiting {
    double lower;
    std::uint64_t number;
    std::uint32_t place, owner;
  };
  static bool is_later(const Waiting& a, const Waiting& b) {
    return a.lower != b.lower ? a.lower > b.lower : a.number < b.number;
  }
  std::vector<Interval>::iterator at(std::uint32_t place) {
    return boxes_.begin() + static_cast<std::ptrdiff_t>(place * longest_);
  }

  std::size_t longest_, used_ = 0;  // used_: places that were taken since clear()
  std::uint64_t count_ = 0;
  std::vector<Interval> boxes_;
  std::vector<Waiting> waiting_;
  std::vector<std::uint32_t> free_;  // places; those from waiting_.size() on are free
};

}  // namespace hcsp::online
