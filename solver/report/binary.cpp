// SPDX-License-Identifier: Apache-2.0
#include "solver/report/binary.h"

#include <cmath>
#include <limits>

namespace hcsp::report {

std::string Bytes::base64() const {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes_.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes_.size(); i += 3) {
    const std::size_t size = bytes_.size() - i < 3 ? bytes_.size() - i : 3;
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = (group << 8U) | (k < size ? bytes_[i + k] : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += k <= size ? kDigits[(group >> (18 - 6 * k)) & 63U] : '=';
  }
  return text;
}

float float_below(double value) {
  constexpr float kMax = std::numeric_limits<float>::max();
  constexpr float kInf = std::numeric_limits<float>::infinity();
  if (value == static_cast<double>(kInf)) return kInf;
  if (value >= static_cast<double>(kMax)) return kMax;
  if (value < static_cast<double>(-kMax)) return -kInf;
  const auto near = static_cast<float>(value);
  return static_cast<double>(near) > value ? std::nextafter(near, -kInf) : near;
}

float float_above(double value) { return -float_below(-value); }

}  // namespace hcsp::report
