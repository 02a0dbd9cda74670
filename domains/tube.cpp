// SPDX-License-Identifier: Apache-2.0
#include "domains/tube.h"

#include <algorithm>

#include "domains/check.h"

namespace hcsp {

namespace {

void require_same_shape(const Tube& a, const Tube& b) {
  require(a.dim() == b.dim() && a.line() == b.line(),
          "Tube: shapes differ (dimensions {} and {}, or time lines)", a.dim(), b.dim());
}

template <class Visit>
void for_each_place(const Tube& a, Visit visit) {
  for (std::size_t c = 0; c < a.dim(); ++c) {
    for (std::size_t item = 0; item < a.items(); ++item) visit(c, item);
  }
}

}  // namespace

Tube::Tube(std::shared_ptr<const TimeLine> line, std::size_t dim)
    : line_(std::move(line)),
      dim_(dim),
      items_(line_->items()),
      lo_(dim * items_, -kInfinity),
      hi_(dim * items_, kInfinity) {
  require(dim >= 1, "Tube: dimension {}", dim);
}

bool Tube::meet_at(std::size_t c, std::size_t item, const Interval& bound) {
  double& lo = lo_[c * items_ + item];
  double& hi = hi_[c * items_ + item];
  if (bound.lo() <= lo && bound.hi() >= hi) return false;
  lo = std::max(lo, bound.lo());
  hi = std::min(hi, bound.hi());
  if (!(lo <= hi)) empty_ = true;
  return true;
}

void Tube::set(std::size_t c, std::size_t item, const Interval& bound) {
  lo_[c * items_ + item] = bound.lo();
  hi_[c * items_ + item] = bound.hi();
  if (bound.is_empty()) empty_ = true;
}

Tube meet(const Tube& a, const Tube& b) {
  Tube met = a;
  contract(met, b);
  return met;
}

Tube join(const Tube& a, const Tube& b) {
  require_same_shape(a, b);
  if (a.is_empty()) return b;
  if (b.is_empty()) return a;
  Tube hull = a;
  for_each_place(
      a, [&](std::size_t c, std::size_t item) { hull.set(c, item, join(a.at(c, item), b.at(c, item))); });
  return hull;
}

bool leq(const Tube& a, const Tube& b) {
  require_same_shape(a, b);
  if (a.is_empty()) return true;
  if (b.is_empty()) return false;
  bool below = true;
  for_each_place(
      a, [&](std::size_t c, std::size_t item) { below = below && leq(a.at(c, item), b.at(c, item)); });
  return below;
}

bool operator==(const Tube& a, const Tube& b) {
  return a.dim() == b.dim() && a.line() == b.line() && leq(a, b) && leq(b, a);
}

Tube top(const Tube& a) { return Tube(a.shared_line(), a.dim()); }

Tube bottom(const Tube& a) {
  Tube empty(a.shared_line(), a.dim());
  empty.empty_ = true;
  return empty;
}

Tube::Delta contract(Tube& a, const Tube& b) {
  require_same_shape(a, b);
  Tube::Delta delta;
  if (a.is_empty()) return delta;
  if (b.is_empty()) {
    a = b;
    return everything(a);
  }
  for_each_place(a, [&](std::size_t c, std::size_t item) {
    if (a.meet_at(c, item, b.at(c, item))) delta.insert(item);
  });
  return delta;
}

Tube::Delta everything(const Tube& a) { return ItemSet::all(a.items()); }

double measure(const Tube& a) {
  if (a.is_empty()) return 0.0;
  double sum = 0.0;
  for (std::size_t k = 0; k < a.line().slices(); ++k) {
    double widest = 0.0;
    for (std::size_t c = 0; c < a.dim(); ++c)
      widest = std::max(widest, a.slice(c, k).hi() - a.slice(c, k).lo());
    sum += widest;
  }
  return sum / static_cast<double>(a.line().slices());
}

namespace {

void require_rows(const char* what, const std::vector<double>& stamps, const std::vector<Box>& values) {
  require(stamps.size() == values.size() && !values.empty(), "{}: {} stamps for {} values", what,
          stamps.size(), values.size());
  for (std::size_t row = 0; row < stamps.size(); ++row) {
    require(row == 0 || stamps[row - 1] < stamps[row], "{}: stamps {} and {} do not increase", what, row,
            row + 1);
    require(values[row].dim() == values.front().dim(), "{}: row {} has another dimension", what, row + 1);
  }
}

}  // namespace

Tube hold(const std::shared_ptr<const TimeLine>& line, const std::vector<double>& stamps,
          const std::vector<Box>& values) {
  require_rows("hold", stamps, values);
  Tube tube(line, static_cast<std::size_t>(values.front().dim()));
  // The rows that meet an item: the one that holds at its start, and those whose stamps lie inside it.
  std::size_t next = 0;  // the first row with a stamp after the item's start
  for (std::size_t item = 0; item < tube.items(); ++item) {
    const Interval span = line->span(item);
    while (next < stamps.size() && stamps[next] <= span.lo()) ++next;
    if (next == 0) continue;
    Box bound = values[next - 1];
    for (std::size_t row = next; row < stamps.size() && stamps[row] < span.hi(); ++row)
      bound = join(bound, values[row]);
    for (std::size_t c = 0; c < tube.dim(); ++c) tube.set(c, item, bound[static_cast<Eigen::Index>(c)]);
  }
  return tube;
}

Tube sampled(const std::shared_ptr<const TimeLine>& line, const std::vector<double>& stamps,
             const std::vector<Box>& values) {
  require_rows("sampled", stamps, values);
  Tube tube(line, static_cast<std::size_t>(values.front().dim()));
  for (std::size_t row = 0; row < stamps.size(); ++row) {
    const auto gate = line->gate_at(stamps[row]);
    require(gate.has_value(), "sampled: the stamp {} is not an instant of the time line", stamps[row]);
    for (std::size_t c = 0; c < tube.dim(); ++c)
      tube.set(c, 2 * *gate, values[row][static_cast<Eigen::Index>(c)]);
  }
  return tube;
}

}  // namespace hcsp
