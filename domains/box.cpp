// SPDX-License-Identifier: Apache-2.0
#include "domains/box.h"

#include <algorithm>

#include "domains/check.h"

namespace hcsp {

namespace {
void require_same_dimension(const Box& a, const Box& b) {
  require(a.dim() == b.dim(), "Box: dimensions {} and {} differ", a.dim(), b.dim());
}

template <class Operation>
Box componentwise(const Box& a, const Box& b, Operation operation) {
  require_same_dimension(a, b);
  Box result(a.dim());
  for (Eigen::Index i = 0; i < a.dim(); ++i) result[i] = operation(a[i], b[i]);
  return result;
}
}  // namespace

Box::Box(std::initializer_list<Interval> components)
    : components_(static_cast<Eigen::Index>(components.size())) {
  std::copy(components.begin(), components.end(), components_.begin());
}

bool Box::is_empty() const {
  return std::any_of(components_.begin(), components_.end(), [](const Interval& c) { return c.is_empty(); });
}

Box meet(const Box& a, const Box& b) {
  const Box met = componentwise(a, b, [](const Interval& x, const Interval& y) { return meet(x, y); });
  return met.is_empty() ? bottom(a) : met;
}

Box join(const Box& a, const Box& b) {
  require_same_dimension(a, b);
  if (a.is_empty()) return b;
  if (b.is_empty()) return a;
  return componentwise(a, b, [](const Interval& x, const Interval& y) { return join(x, y); });
}

bool leq(const Box& a, const Box& b) {
  require_same_dimension(a, b);
  if (a.is_empty()) return true;
  for (Eigen::Index i = 0; i < a.dim(); ++i) {
    if (!leq(a[i], b[i])) return false;
  }
  return true;
}

bool operator==(const Box& a, const Box& b) { return a.dim() == b.dim() && leq(a, b) && leq(b, a); }
Box top(const Box& a) { return Box(a.dim()); }
Box bottom(const Box& a) { return Box(IntervalVector::Constant(a.dim(), Interval::empty())); }

Box::Delta contract(Box& a, const Box& b) {
  Box met = meet(a, b);
  const bool changed = !(met == a);
  a = std::move(met);
  return {changed};
}

double measure(const Box& a) {
  double widest = 0.0;
  for (const Interval& c : a.components()) widest = std::max(widest, c.width());
  return widest;
}

std::string to_string(const Box& a) {
  std::string text = "(";
  for (Eigen::Index i = 0; i < a.dim(); ++i) {
    if (i > 0) text += ", ";
    text += to_string(a[i]);
  }
  text += ')';
  return text;
}

}  // namespace hcsp
