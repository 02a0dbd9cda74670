// SPDX-License-Identifier: Apache-2.0
// Tubes: intervals of functions of time, [f-, f+] pointwise (Jaulin 2011, section III-B). Over each open
// slice an envelope, at each instant a gate. The function may jump: gates and slices bound each other only
// under a constraint that makes it continuous (der).
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "domains/box.h"
#include "domains/time_line.h"

namespace hcsp {

class Tube {
 public:
  /// The set of items that changed.
  using Delta = ItemSet;

  /// All functions from the time line to R^dim. The line is shared by every tube of a model and by its
  /// results.
  Tube(std::shared_ptr<const TimeLine> line, std::size_t dim);

  [[nodiscard]] const TimeLine& line() const { return *line_; }
  [[nodiscard]] const std::shared_ptr<const TimeLine>& shared_line() const { return line_; }
  [[nodiscard]] std::size_t dim() const { return dim_; }
  [[nodiscard]] std::size_t items() const { return items_; }
  [[nodiscard]] bool is_empty() const { return empty_; }

  /// Component c (from 0) at an item.
  [[nodiscard]] Interval at(std::size_t c, std::size_t item) const {
    return Interval::raw(lo_[c * items_ + item], hi_[c * items_ + item]);
  }
  [[nodiscard]] Interval gate(std::size_t c, std::size_t i) const { return at(c, 2 * i); }
  [[nodiscard]] Interval slice(std::size_t c, std::size_t k) const { return at(c, 2 * k + 1); }
  /// The bounds of component c over all items, contiguous in the order of time.
  [[nodiscard]] const double* lo(std::size_t c) const { return &lo_[c * items_]; }
  [[nodiscard]] const double* hi(std::size_t c) const { return &hi_[c * items_]; }

  /// Replaces component c at an item by its meet with bound; true if that changed it. An empty meet empties
  /// the tube.
  bool meet_at(std::size_t c, std::size_t item, const Interval& bound);
  /// Sets component c at an item; for building given tubes. An empty bound empties the tube.
  void set(std::size_t c, std::size_t item, const Interval& bound);

 private:
  friend Tube bottom(const Tube& a);

  std::shared_ptr<const TimeLine> line_;
  std::size_t dim_;
  std::size_t items_;
  bool empty_ = false;
  std::vector<double> lo_, hi_;  // component by component, item by item
};

// Shapes (line and dimension) must agree: std::invalid_argument otherwise.
Tube meet(const Tube& a, const Tube& b);
Tube join(const Tube& a, const Tube& b);
bool leq(const Tube& a, const Tube& b);
bool operator==(const Tube& a, const Tube& b);
Tube top(const Tube& a);
Tube bottom(const Tube& a);
Tube::Delta contract(Tube& a, const Tube& b);
Tube::Delta everything(const Tube& a);
/// The mean over the slices of the widest component.
double measure(const Tube& a);

/// A given tube that keeps each row's value from its stamp until the next stamp, the last until the end of
/// the line; before the first stamp nothing is known. values[r] has the tube's dimension; stamps increase
/// strictly. A slice that a stamp divides is bounded by the hull of the values that meet it.
Tube hold(const std::shared_ptr<const TimeLine>& line, const std::vector<double>& stamps,
          const std::vector<Box>& values);
/// A given tube that is known at its stamps only, which must be instants of the line; nothing is known
/// between them.
Tube sampled(const std::shared_ptr<const TimeLine>& line, const std::vector<double>& stamps,
             const std::vector<Box>& values);

static_assert(Lattice<Tube>);

}  // namespace hcsp
