// SPDX-License-Identifier: Apache-2.0
// The time line of a model: instants t_0 < ... < t_N. Between them lie N open slices. Every tube of a model
// stands on the same line, so no two tubes can disagree about their slicing. An item is a gate or a slice, in
// the order of time: item 2i is the gate at t_i, item 2k + 1 the slice (t_k, t_{k+1}).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "domains/interval/interval.h"

namespace hcsp {

class TimeLine {
 public:
  /// Throws std::invalid_argument unless there are two instants or more, finite and strictly increasing.
  explicit TimeLine(std::vector<double> instants);

  /// The grid start, start + step, ... up to and with end, joined with the further instants that lie in
  /// [start, end]. A grid instant nearer than 1e-6 steps to a further instant is that instant: 3 * 0.1 and
  /// the stamp 0.3 are one. Throws std::invalid_argument unless start < end, step > 0 and the grid has at
  /// most kMostInstants instants.
  static TimeLine grid(double start, double end, double step, const std::vector<double>& further = {});
  static constexpr double kMostInstants = 1e8;

  [[nodiscard]] std::size_t slices() const { return instants_.size() - 1; }
  [[nodiscard]] std::size_t items() const { return 2 * instants_.size() - 1; }
  [[nodiscard]] const std::vector<double>& instants() const { return instants_; }
  [[nodiscard]] double start() const { return instants_.front(); }
  [[nodiscard]] double end() const { return instants_.back(); }
  /// The closed interval of the item's instants: a point for a gate.
  [[nodiscard]] Interval span(std::size_t item) const;
  /// The index i of the gate with t_i == t, if t is an instant.
  [[nodiscard]] std::optional<std::size_t> gate_at(double t) const;

  friend bool operator==(const TimeLine&, const TimeLine&) = default;

 private:
  std::vector<double> instants_;
};

/// A set of items of a time line, as one bit each.
class ItemSet {
 public:
  ItemSet() = default;
  static ItemSet all(std::size_t items);
  /// The items first..last.
  static ItemSet range(std::size_t first, std::size_t last);
  [[nodiscard]] bool is_none() const;
  [[nodiscard]] bool contains(std::size_t item) const {
    return item / 64 < words_.size() && ((words_[item / 64] >> (item % 64)) & 1U) != 0;
  }
  void insert(std::size_t item);
  void join(const ItemSet& other);
  void meet(const ItemSet& other);
  [[nodiscard]] const std::vector<std::uint64_t>& words() const { return words_; }

  /// Calls visit(item) for every member, in the order of time.
  template <class Visit>
  void for_each(Visit visit) const {
    for (std::size_t w = 0; w < words_.size(); ++w) {
      for (std::uint64_t word = words_[w]; word != 0; word &= word - 1) {
        visit(64 * w + static_cast<std::size_t>(__builtin_ctzll(word)));
      }
    }
  }

 private:
  std::vector<std::uint64_t> words_;
};

}  // namespace hcsp
