// SPDX-License-Identifier: Apache-2.0
#include "solver/contractors/derivative.h"

#include <algorithm>

#include "domains/interval/kernel.h"
#include "domains/rounding.h"

namespace hcsp {

namespace {

constexpr std::size_t kLanes = 64;

// An upper bound of x over a slice of length dt, where x starts at most at x0, ends at most at x1, and its
// slope stays in v: the maximum over time of the lesser of the two lines that the ends allow. Where the lines
// cross at a peak, its height is p x0 + q x1 + r, a weighted mean of the ends raised by r. For a given v that
// is isotone in the ends to the last bit; a narrower v may give a peak that is higher by a rounding error.
double slice_upper(double x0, double x1, const Interval& v, const Interval& dt) {
  const double from_start = std::max(x0, up::add(Interval::raw(x0, x0), up::mul(v, dt)).hi());
  const double from_end = std::max(x1, up::sub(Interval::raw(x1, x1), up::mul(v, dt)).hi());
  const double corner = std::min(from_start, from_end);
  const bool peak = v.lo() < 0 && v.hi() > 0 && v.is_bounded() && std::isfinite(x0) && std::isfinite(x1);
  if (!peak) return corner;
  const Interval fall(-v.lo()), rise(v.hi());
  const Interval slopes = up::add(rise, fall);
  const Interval p = up::div(fall, slopes), q = up::div(rise, slopes);
  const Interval r = up::mul(up::mul(p, rise), dt);
  const double height =
      up::add(up::add(up::mul(p, Interval::raw(x0, x0)), up::mul(q, Interval::raw(x1, x1))), r).hi();
  return std::min(corner, height);
}

Interval slice_hull(const Interval& x0, const Interval& x1, const Interval& v, const Interval& dt) {
  return Interval::raw(-slice_upper(-x0.lo(), -x1.lo(), -v, dt), slice_upper(x0.hi(), x1.hi(), v, dt));
}

class DerivativeContractor final : public Contractor, public Motion {
 public:
  DerivativeContractor(const std::string& name, VariableId x, std::size_t dim,
                       std::vector<std::size_t> components, Program program, Inputs inputs,
                       const Inputs::Context& context)
      : Contractor(name, name, Cost::linear, with(inputs.variables(), x), {x}),
        x_(x),
        f_depends_on_x_(std::count(inputs.variables().begin(), inputs.variables().end(), x) > 0),
        line_(context.line),
        program_(std::move(program)),
        inputs_(std::move(inputs)),
        evaluation_(program_, kLanes),
        components_(std::move(components)),
        slopes_(dim, std::vector<Interval>(line_->slices())),
        steps_(slopes_) {
    const auto in_window = [&](std::size_t k) {
      return context.window == nullptr || context.window->contains(2 * k + 1);
    };
    while (first_ < line_->slices() && !in_window(first_)) ++first_;
    end_ = first_;
    while (end_ < line_->slices() && in_window(end_)) ++end_;
  }

  void begin() override {
    for (auto& steps : steps_) std::fill(steps.begin(), steps.end(), Interval::entire());
  }

  [[nodiscard]] const Interval& step(std::size_t component, std::size_t slice) const override {
    return steps_[component][slice];
  }

  void contract(Access& access) override {
    RoundUpward guard;
    inputs_.open(access);
    if (!update_slopes(access)) return;
    Tube& x = access.edit<Tube>(x_);
    ItemSet before = access.delta<Tube>(x_);
    before.join(new_slopes_);
    ItemSet changes;
    std::optional<std::array<double, 2>> when;
    for (const std::size_t c : components_) {
      if (x.is_empty()) break;
      ItemSet moved = before;
      const auto meet_at = [&](std::size_t item, const Interval& bound) {
        if (x.is_empty() || !x.meet_at(c, item, bound)) return;
        moved.insert(item);
        changes.insert(item);
        if (x.is_empty()) when = when_at(item);
      };
      meet_gates_with_slices(x, c, meet_at);
      while (!moved.is_none() && !x.is_empty()) {
        sweep(x, c, moved, meet_at);
        moved = {};
        meet_gates_with_slices(x, c, meet_at);
      }
    }
    access.report<Tube>(x_, changes, when);
    // A second sweep forward, or back, finds nothing: a gate that was narrowed by its neighbour gives back,
    // rounded outward, at least what the neighbour has. And the gates lie within their slices. So all is
    // settled, unless f itself depends on x.
    if (!f_depends_on_x_) access.settled();
  }

 private:
  static std::vector<VariableId> with(std::vector<VariableId> variables, VariableId x) {
    if (std::find(variables.begin(), variables.end(), x) == variables.end()) variables.push_back(x);
    return variables;
  }

  // Re-evaluates f over the slices where an input changed. False when f has no value somewhere.
  bool update_slopes(Access& access) {
    new_slopes_ = {};
    std::vector<std::size_t> slices;
    bool alive = true;
    const auto flush = [&] {
      if (alive && !slices.empty()) alive = evaluate(access, slices);
      slices.clear();
    };
    // An untimed f has one item, which stands for every slice.
    const ItemSet changed = inputs_.changed(access);
    for (std::size_t k = first_; k < end_; ++k) {
      if (!changed.contains(inputs_.timed() ? 2 * k + 1 : 0)) continue;
      slices.push_back(k);
      if (slices.size() == kLanes) flush();
    }
    flush();
    return alive;
  }

  bool evaluate(Access& access, const std::vector<std::size_t>& slices) {
    for (std::size_t lane = 0; lane < slices.size(); ++lane) {
      inputs_.load(evaluation_, inputs_.timed() ? 2 * slices[lane] + 1 : 0, lane);
    }
    evaluation_.forward(slices.size());
    for (std::size_t lane = 0; lane < slices.size(); ++lane) {
      const std::size_t k = slices[lane];
      const Interval dt = duration(k);
      for (std::size_t i = 0; i < components_.size(); ++i) {
        const std::size_t c = components_[i];
        slopes_[c][k] = evaluation_.get(program_.root(i), lane);
        if (slopes_[c][k].is_empty()) {
          access.fail(x_, when_at(2 * k + 1));
          return false;
        }
        steps_[c][k] = up::mul(slopes_[c][k], dt);
      }
      new_slopes_.insert(2 * k + 1);
    }
    return true;
  }

  [[nodiscard]] std::array<double, 2> when_at(std::size_t item) const {
    const Interval span = line_->span(item);
    return {span.lo(), span.hi()};
  }

  [[nodiscard]] Interval duration(std::size_t k) const {
    const double t0 = line_->instants()[k], t1 = line_->instants()[k + 1];
    return Interval::raw(up::sub_down(t1, t0), t1 - t0);
  }

  // One sweep forward, one back, then the slices whose ends moved. `moved` grows as the sweep goes.
  template <class MeetAt>
  void sweep(const Tube& x, std::size_t c, ItemSet& moved, const MeetAt& meet_at) {
    for (std::size_t k = first_; k < end_; ++k) {
      const std::size_t before = 2 * k, slice = before + 1, after = before + 2;
      if (moved.contains(before) || moved.contains(slice))
        meet_at(after, up::add(x.at(c, before), steps_[c][k]));
    }
    for (std::size_t k = end_; k-- > first_;) {
      const std::size_t before = 2 * k, slice = before + 1, after = before + 2;
      if (moved.contains(after) || moved.contains(slice))
        meet_at(before, up::sub(x.at(c, after), steps_[c][k]));
    }
    for (std::size_t k = first_; k < end_ && !x.is_empty(); ++k) {
      const std::size_t before = 2 * k, slice = before + 1, after = before + 2;
      if (!moved.contains(before) && !moved.contains(slice) && !moved.contains(after)) continue;
      meet_at(slice, slice_hull(x.at(c, before), x.at(c, after), slopes_[c][k], duration(k)));
    }
  }

  // x is continuous: at a gate it is the limit of what it is over the slices beside it.
  template <class MeetAt>
  void meet_gates_with_slices(const Tube& x, std::size_t c, const MeetAt& meet_at) {
    for (std::size_t k = first_; k < end_; ++k) {
      const Interval slice = x.at(c, 2 * k + 1);
      meet_at(2 * k, slice);
      meet_at(2 * k + 2, slice);
    }
  }

  VariableId x_;
  bool f_depends_on_x_;
  std::shared_ptr<const TimeLine> line_;
  std::size_t first_ = 0, end_ = 0;  // the slices at hand
  Program program_;
  Inputs inputs_;
  Evaluation evaluation_;
  ItemSet new_slopes_;
  std::vector<std::size_t> components_;        // of x: those whose derivatives these are
  std::vector<std::vector<Interval>> slopes_;  // [f] by component of x and slice
  std::vector<std::vector<Interval>> steps_;   // [f] dt
};

}  // namespace

std::unique_ptr<Contractor> make_derivative_contractor(std::string name, VariableId x, std::size_t dim,
                                                       std::vector<std::size_t> components, const Dag& dag,
                                                       const std::vector<NodeId>& f,
                                                       const Inputs::Context& context) {
  Program program(dag, f);
  Inputs inputs(program, context);
  auto contractor = std::make_unique<DerivativeContractor>(name, x, dim, std::move(components),
                                                           std::move(program), std::move(inputs), context);
  (*context.motions)[x].push_back(contractor.get());
  return contractor;
}

}  // namespace hcsp
