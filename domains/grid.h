// SPDX-License-Identifier: Apache-2.0
// A regular grid over R^n: cell i of an axis is [line(i), line(i + 1)), line(i) the double nearest i h. The
// cells are half-open, so they partition space.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "domains/interval/interval.h"

namespace hcsp {

/// An index of cells along the axes; unused axes are 0.
using CellIndex = std::array<std::int64_t, 3>;

class Grid {
 public:
  /// Cells are addressable while their indices are below this in absolute value; space beyond has no cells.
  static constexpr std::int64_t kReach = std::int64_t{1} << 28;

  /// Cells of edge `precision` in R^dim. Throws std::invalid_argument unless dim is 1 to 3 and the precision
  /// a positive finite number.
  Grid(std::size_t dim, double precision);

  [[nodiscard]] std::size_t dim() const { return dim_; }
  [[nodiscard]] double precision() const { return precision_; }
  /// The double nearest i h, in whatever rounding mode it is asked.
  [[nodiscard]] double line(std::int64_t i) const {
    const std::int64_t place = i + kTabulated;
    return place >= 0 && place <= 2 * kTabulated ? lines_[static_cast<std::size_t>(place)] : exact_line(i);
  }
  /// line(first), line(first + step) and so on.
  template <std::size_t kCount>
  [[nodiscard]] std::array<double, kCount> lines(std::int64_t first, std::int64_t step) const {
    std::array<double, kCount> lines{};
    const std::int64_t place = first + kTabulated;
    const bool tabulated =
        place >= 0 && place + step * static_cast<std::int64_t>(kCount - 1) <= 2 * kTabulated;
    for (std::size_t i = 0; i < kCount; ++i) {
      const std::int64_t ahead = step * static_cast<std::int64_t>(i);
      lines[i] = tabulated ? lines_[static_cast<std::size_t>(place + ahead)] : exact_line(first + ahead);
    }
    return lines;
  }
  /// The cell that holds x: line(i) <= x < line(i + 1); clamped to the addressable cells.
  [[nodiscard]] std::int64_t cell_of(double x) const;

  friend bool operator==(const Grid& a, const Grid& b) {
    return a.dim_ == b.dim_ && a.precision_ == b.precision_;
  }

 private:
  static constexpr std::int64_t kTabulated = 1024;
  [[nodiscard]] double exact_line(std::int64_t i) const;

  std::size_t dim_;
  double precision_;
  std::uint64_t significand_;  // precision = significand * 2^exponent, exactly
  int exponent_;
  std::vector<double> lines_;  // of the indices around 0, where most of the work is
};

}  // namespace hcsp
