// SPDX-License-Identifier: Apache-2.0
// A set of cases, by number: a bit each.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

namespace hcsp::online {

class CaseSet {
 public:
  /// An empty set of some of the first `count` cases.
  explicit CaseSet(std::size_t count) : words_((count + kBits - 1) / kBits) {}

  /// Makes it the first `count` cases.
  void fill(std::size_t count) {
    for (std::size_t i = 0; i < words_.size(); ++i) {
      const std::size_t more = count - std::min(count, kBits * i);
      words_[i] = more < kBits ? (std::uint64_t{1} << more) - 1 : ~std::uint64_t{0};
    }
  }
  void insert(std::size_t number) { words_[number / kBits] |= std::uint64_t{1} << number % kBits; }
  void insert(const CaseSet& others) {
    for (std::size_t i = 0; i < words_.size(); ++i) words_[i] |= others.words_[i];
  }
  /// Takes out the others that are not among those to keep; how many it had of them.
  std::uint32_t remove(const CaseSet& others, const CaseSet& kept) {
    int removed = 0;
    for (std::size_t i = 0; i < words_.size(); ++i) {
      const std::uint64_t word = words_[i] & others.words_[i] & ~kept.words_[i];
      removed += std::popcount(word);
      words_[i] &= ~word;
    }
    return static_cast<std::uint32_t>(removed);
  }
  [[nodiscard]] bool contains(std::size_t number) const {
    return ((words_[number / kBits] >> number % kBits) & 1U) != 0;
  }
  [[nodiscard]] bool meets(const CaseSet& others) const {
    bool is_met = false;
    for (std::size_t i = 0; i < words_.size(); ++i) is_met = is_met || (words_[i] & others.words_[i]) != 0;
    return is_met;
  }
  [[nodiscard]] std::size_t size() const {
    std::size_t sum = 0;
    for (const std::uint64_t word : words_) sum += static_cast<std::size_t>(std::popcount(word));
    return sum;
  }

 private:
  static constexpr std::size_t kBits = 64;
  std::vector<std::uint64_t> words_;
};

}  // namespace hcsp::online
