// SPDX-License-Identifier: Apache-2.0
#include "solver/search/shaving.h"

#include <algorithm>

namespace hcsp {

namespace {
constexpr int kSlices = 10;
}

bool Shaving::contract(std::vector<Interval>& box, std::uint32_t v) {
  const Interval domain = box[v];
  const double step = (domain.hi() - domain.lo()) / kSlices;
  if (!domain.is_bounded() || !(domain.lo() + step < domain.hi())) return true;
  const auto try_slice = [&](double lo, double hi) {
    slice_ = box;
    slice_[v] = Interval::raw(lo, hi);
    return hc4_.contract(slice_, v);
  };
  const auto bound = [&](int k) { return k == kSlices ? domain.hi() : domain.lo() + k * step; };
  int first = 0;
  while (first < kSlices && !try_slice(bound(first), bound(first + 1))) ++first;
  if (first == kSlices) return false;
  hull_ = slice_;
  int last = kSlices - 1;
  while (last > first && !try_slice(bound(last), bound(last + 1))) --last;
  const auto widen = [&] {
    for (std::size_t u = 0; u < box.size(); ++u) hull_[u] = join(hull_[u], slice_[u]);
  };
  if (last > first) widen();
  if (last > first + 1 && try_slice(bound(first + 1), bound(last))) widen();
  box.swap(hull_);
  return true;
}

}  // namespace hcsp
