// SPDX-License-Identifier: Apache-2.0
#include "solver/contractors/delay.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "domains/tube.h"
#include "solver/engine/propagation.h"

namespace hcsp {

namespace {

// The items of which one, at each instant of a span, is at hand.
struct ItemRange {
  std::size_t first;
  std::size_t last;
};

// Where an instant lies on the line; none off it.
std::optional<std::size_t> item_at(const TimeLine& line, double t, double scale) {
  const std::vector<double>& instants = line.instants();
  const double close = 4 * std::numeric_limits<double>::epsilon() * scale;
  const auto next = std::lower_bound(instants.begin(), instants.end(), t);
  const auto gate = [&](auto at) { return 2 * static_cast<std::size_t>(at - instants.begin()); };
  if (next != instants.end() && *next - t <= close) return gate(next);
  if (next != instants.begin() && t - *(next - 1) <= close) return gate(next - 1);
  if (next == instants.begin() || next == instants.end()) return {};
  return gate(next) - 1;
}

// The items of the line moved by an offset; none where the line does not reach over all of one.
std::vector<std::optional<ItemRange>> moved_items(const TimeLine& line, double offset) {
  std::vector<std::optional<ItemRange>> moved(line.items());
  for (std::size_t item = 0; item < line.items(); ++item) {
    const Interval span = line.span(item);
    const double scale = std::max({std::abs(span.lo()), std::abs(span.hi()), std::abs(offset)});
    auto first = item_at(line, span.lo() + offset, scale), last = item_at(line, span.hi() + offset, scale);
    if (!first || !last) continue;
    if (item % 2 != 0) {  // an open span: gates at its ends are outside of it
      if (*first % 2 == 0) ++*first;
      if (*last % 2 == 0) --*last;
      if (*first > *last) continue;  // thinner than rounding tells
    }
    moved[item] = ItemRange{*first, *last};
  }
  return moved;
}

class DelayContractor final : public Contractor {
 public:
  DelayContractor(const std::string& name, VariableId y, VariableId x, const TimeLine& line, double delay)
      : Contractor(name, name, Cost::linear, {y, x}, {y, x}),
        y_(y),
        x_(x),
        back_(moved_items(line, -delay)),
        ahead_(moved_items(line, delay)) {}

  void contract(Access& access) override {
    take(access, y_, x_, back_);
    take(access, x_, y_, ahead_);
  }

 private:
  // At every item the target is within the hull of what the source is over the moved item.
  static void take(Access& access, VariableId target, VariableId source,
                   const std::vector<std::optional<ItemRange>>& moved) {
    auto& tube = access.edit<Tube>(target);
    const auto& from = access.domain<Tube>(source);
    ItemSet changes;
    for (std::size_t item = 0; item < moved.size() && !tube.is_empty(); ++item) {
      if (!moved[item]) continue;
      for (std::size_t c = 0; c < tube.dim(); ++c) {
        Interval hull = from.at(c, moved[item]->first);
        for (std::size_t k = moved[item]->first + 1; k <= moved[item]->last; ++k)
          hull = join(hull, from.at(c, k));
        if (tube.meet_at(c, item, hull)) changes.insert(item);
      }
    }
    access.report<Tube>(target, changes);
  }

  VariableId y_, x_;
  std::vector<std::optional<ItemRange>> back_, ahead_;  // by item
};

}  // namespace

std::unique_ptr<Contractor> make_delay_contractor(std::string name, VariableId y, VariableId x,
                                                  const TimeLine& line, double delay) {
  return std::make_unique<DelayContractor>(name, y, x, line, delay);
}

}  // namespace hcsp
