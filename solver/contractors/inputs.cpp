// SPDX-License-Identifier: Apache-2.0
#include "solver/contractors/inputs.h"

#include <algorithm>

#include "domains/interval/kernel.h"

namespace hcsp {

Inputs::Inputs(const Program& program, Context context)
    : inputs_(program.inputs()), context_(std::move(context)) {
  for (std::uint32_t i = 0; i < inputs_.size(); ++i) {
    const Input& input = inputs_[i];
    timed_ = timed_ || input.kind == Input::Kind::tube || input.kind == Input::Kind::time;
    place_of_.push_back(0);
    if (input.kind == Input::Kind::point) {
      point_.resize(std::max<std::size_t>(point_.size(), input.component + 1), kNone);
      point_[input.component] = i;
    }
    if (input.kind == Input::Kind::point || input.kind == Input::Kind::time) continue;
    contractible_.push_back(i);
    const auto known = std::find(variables_.begin(), variables_.end(), input.variable);
    place_of_[i] = static_cast<std::size_t>(known - variables_.begin());
    if (known != variables_.end()) continue;
    variables_.push_back(input.variable);
    places_.emplace_back();
    places_.back().kind = input.kind == Input::Kind::gate ? Input::Kind::tube : input.kind;
  }
}

void Inputs::open(Access& access) {
  for (std::size_t v = 0; v < places_.size(); ++v) {
    Place& place = places_[v];
    place.changed = false;
    place.items = {};
    place.emptied_at.reset();
    switch (place.kind) {
      case Input::Kind::real:
        place.real = &access.edit<Interval>(variables_[v]);
        break;
      default:
        place.tube = &access.edit<Tube>(variables_[v]);
        break;
    }
  }
}

ItemSet Inputs::changed(const Access& access) const {
  ItemSet changed;
  bool everywhere = false;
  for (std::size_t v = 0; v < places_.size(); ++v) {
    if (places_[v].kind == Input::Kind::real)
      everywhere = everywhere || !access.delta<Interval>(variables_[v]).is_none();
  }
  for (std::size_t i = 0; i < inputs_.size(); ++i) {
    const Input& input = inputs_[i];
    if (input.kind == Input::Kind::tube) changed.join(access.delta<Tube>(input.variable));
    if (input.kind == Input::Kind::gate) {
      everywhere = everywhere || access.delta<Tube>(input.variable).contains(item_of(input, 0));
    }
  }
  // A program of constants and the time alone has nothing that could change: look once.
  if (variables_.empty()) everywhere = true;
  if (everywhere) return in_window();
  if (timed_ && context_.window) changed.meet(*context_.window);
  return changed;
}

ItemSet Inputs::in_window() const {
  return timed_ && context_.window ? *context_.window : ItemSet::all(items());
}

Interval Inputs::value(std::uint32_t i, std::size_t item) const {
  const Input& input = inputs_[i];
  switch (input.kind) {
    case Input::Kind::real:
      return *places_[place_of_[i]].real;
    case Input::Kind::time:
      return context_.line->span(item);
    case Input::Kind::point:
      return Interval::entire();
    default:
      return places_[place_of_[i]].tube->at(input.component, item_of(input, item));
  }
}

bool Inputs::no_reading_at(std::size_t item) const {
  return std::any_of(contractible_.begin(), contractible_.end(), [&](std::uint32_t i) {
    return context_.sampled->contains(inputs_[i].variable) && value(i, item).is_entire();
  });
}

void Inputs::load(Evaluation& evaluation, std::size_t item, std::size_t lane) const {
  for (std::uint32_t i = 0; i < inputs_.size(); ++i) evaluation.set(i, value(i, item), lane);
}

bool Inputs::narrow(std::uint32_t i, std::size_t item, const Interval& bound) {
  const Input& input = inputs_[i];
  Place& place = places_[place_of_[i]];
  if (place.kind == Input::Kind::tube) {
    const std::size_t at = item_of(input, item);
    if (place.tube->meet_at(input.component, at, bound)) place.items.insert(at);
    if (place.tube->is_empty() && !place.emptied_at) place.emptied_at = at;
    return !place.tube->is_empty();
  }
  place.changed = contract(*place.real, bound).changed || place.changed;
  return !place.real->is_empty();
}

bool Inputs::carry(std::size_t item, Direction sweep) {
  if (!timed_ || item % 2 != 0) return false;
  const bool forward = sweep == Direction::forward;
  if (item == (forward ? 0 : context_.line->items() - 1)) return false;
  const std::size_t from = forward ? item - 2 : item + 2, slice = (forward ? item - 1 : item + 1) / 2;
  bool changed = false;
  for (const std::uint32_t i : contractible_) {
    if (inputs_[i].kind != Input::Kind::tube) continue;
    const auto motions = context_.motions->find(inputs_[i].variable);
    if (motions == context_.motions->end()) continue;
    for (const Motion* motion : motions->second) {
      const Interval& step = motion->step(inputs_[i].component, slice);
      const Interval before = value(i, item), start = value(i, from);
      narrow(i, item, forward ? up::add(start, step) : up::sub(start, step));
      changed = changed || !(value(i, item) == before);
    }
  }
  return changed;
}

bool Inputs::store(const Evaluation& evaluation, std::size_t item, std::size_t lane) {
  bool alive = true;
  for (const std::uint32_t i : contractible_) alive = narrow(i, item, evaluation.get(i, lane)) && alive;
  return alive;
}

void Inputs::report(Access& access) {
  for (std::size_t v = 0; v < places_.size(); ++v) {
    Place& place = places_[v];
    switch (place.kind) {
      case Input::Kind::real:
        access.report<Interval>(variables_[v], {place.changed});
        break;
      default:
        access.report<Tube>(variables_[v], place.items,
                            place.emptied_at ? std::optional(span_of(*place.emptied_at)) : std::nullopt);
    }
  }
}

std::optional<std::array<double, 2>> Inputs::when(std::size_t item) const {
  if (!timed_) {  // the one instant that the program speaks of, if it is one
    std::optional<std::size_t> gate;
    for (const Input& input : inputs_) {
      if (input.kind != Input::Kind::gate) continue;
      if (gate && *gate != item_of(input, 0)) return std::nullopt;
      gate = item_of(input, 0);
    }
    if (!gate) return std::nullopt;
    item = *gate;
  }
  return span_of(item);
}

std::array<double, 2> Inputs::span_of(std::size_t item) const {
  const Interval span = context_.line->span(item);
  return {span.lo(), span.hi()};
}

}  // namespace hcsp
