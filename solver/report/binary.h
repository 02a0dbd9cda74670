// SPDX-License-Identifier: Apache-2.0
// Arrays of numbers as base64 of their little-endian bytes, what a typed array of a browser reads without
// parsing.
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace hcsp::report {

class Bytes {
 public:
  template <class Number>
  requires(std::integral<Number> || std::floating_point<Number>) void put(Number value) {
    using Word = std::conditional_t<sizeof(Number) == 8, std::uint64_t,
                                    std::conditional_t<sizeof(Number) == 4, std::uint32_t, std::uint16_t>>;
    const auto word = std::bit_cast<Word>(value);
    for (unsigned shift = 0; shift < 8 * sizeof(Number); shift += 8) {
      bytes_.push_back(static_cast<std::uint8_t>((word >> shift) & 0xffU));
    }
  }
  [[nodiscard]] std::string base64() const;

 private:
  std::vector<std::uint8_t> bytes_;
};

/// The largest float that is not above, and the smallest that is not below, a double.
float float_below(double value);
float float_above(double value);

}  // namespace hcsp::report
