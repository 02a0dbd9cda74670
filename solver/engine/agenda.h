// SPDX-License-Identifier: Apache-2.0
// The awake contractors of a propagation, by their places in its schedule.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace hcsp {

class Agenda {
 public:
  Agenda() = default;
  /// All of `count` places are awake.
  explicit Agenda(std::size_t count) : words_((count + 63) / 64, ~std::uint64_t{0}) {
    if (count % 64 != 0) words_.back() >>= 64 - count % 64;
  }

  void wake(std::size_t place) {
    words_[place / 64] |= std::uint64_t{1} << place % 64;
    if (place / 64 < first_) first_ = place / 64;
  }
  void put_to_sleep(std::size_t place) { words_[place / 64] &= ~(std::uint64_t{1} << place % 64); }
  /// The first awake place.
  [[nodiscard]] std::optional<std::size_t> next() {
    for (; first_ < words_.size(); ++first_) {
      const std::uint64_t word = words_[first_];
      if (word != 0) return 64 * first_ + static_cast<std::size_t>(__builtin_ctzll(word));
    }
    return std::nullopt;
  }

 private:
  std::vector<std::uint64_t> words_;
  std::size_t first_ = 0;  // no place of an earlier word is awake
};

}  // namespace hcsp
