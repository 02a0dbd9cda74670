// SPDX-License-Identifier: Apache-2.0
#include "solver/engine/propagation.h"

#include <algorithm>
#include <chrono>
#include <random>

namespace hcsp {

Clock steady_clock() {
  return [] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  };
}

void Access::fail(VariableId variable, std::optional<std::array<double, 2>> time) {
  if (!run_.failure_) run_.failure_ = Failure{contractor_, variable, time};
}

std::size_t Access::place_in(VariableId id) const {
  return std::lower_bound(places_.begin(), places_.end(), std::pair(id, std::size_t{0}))->second;
}

const Slot& Access::slot(VariableId id) const { return *run_.slots_[id]; }
bool Access::changed(VariableId id) const { return run_.slots_[id]->changed(place_in(id)); }

void Access::narrow(VariableId id, const Slot& bound) {
  Slot& slot = *run_.slots_[id];
  if (slot.narrow(bound)) {
    for (const ContractorId reader : run_.graph_.variable(id).readers())
      run_.agenda_.wake(run_.turn_[reader]);
  }
  if (slot.is_empty()) fail(id);
}

PropagationOptions Access::limits() const {
  PropagationOptions options;
  options.cancel = run_.options_.cancel;
  options.clock = run_.options_.clock;
  // One that has passed leaves next to nothing: 0 would be no limit.
  constexpr double kNextToNothing = 1e-9;
  if (run_.options_.time_limit > 0)
    options.time_limit = std::max(run_.options_.time_limit - run_.elapsed(), kNextToNothing);
  options.threshold = run_.options_.threshold;
  return options;
}

void Access::settled() { settled_ = true; }

bool Access::should_stop() const { return run_.failure_.has_value() || run_.out_of_limits(); }

Propagation::Propagation(const ContractorGraph& graph, PropagationOptions options)
    : graph_(graph),
      options_(std::move(options)),
      started_(options_.clock()),
      counts_(graph.contractors().size()) {
  for (const auto& variable : graph.variables())
    slots_.push_back(variable.present() ? variable.initial().clone() : nullptr);
  const std::size_t contractors = graph.contractors().size();
  for (ContractorId id = 0; id < contractors; ++id) {
    access_.push_back(Access(*this, id));
    schedule_.push_back(id);
  }
  for (VariableId v = 0; v < graph.variables().size(); ++v) {
    const auto& readers = graph.variable(v).readers();
    for (std::size_t place = 0; place < readers.size(); ++place)
      access_[readers[place]].places_.emplace_back(v, place);
  }
  Cost dearest = Cost::constant;
  for (const auto& contractor : graph.contractors()) dearest = std::max(dearest, contractor->cost());
  counted_ = std::min(dearest, Cost::linear);
  if (options_.order == Order::reversed) std::reverse(schedule_.begin(), schedule_.end());
  if (options_.order == Order::shuffled) {
    std::mt19937_64 random(options_.seed);
    std::shuffle(schedule_.begin(), schedule_.end(), random);
  }
  std::stable_sort(schedule_.begin(), schedule_.end(), [&](ContractorId a, ContractorId b) {
    return graph.contractors()[a]->cost() < graph.contractors()[b]->cost();
  });
  turn_.resize(contractors);
  for (std::size_t turn = 0; turn < contractors; ++turn) turn_[schedule_[turn]] = turn;
}

bool Propagation::out_of_limits() const {
  if (options_.cancel != nullptr && options_.cancel->load(std::memory_order_relaxed)) return true;
  return options_.time_limit > 0 && elapsed() >= options_.time_limit;
}

void Propagation::run_contractor(ContractorId id, Observer* observer) {
  Contractor& contractor = *graph_.contractors()[id];
  agenda_.put_to_sleep(turn_[id]);
  ran_this_pass_[id] = contractor.cost() >= counted_;
  for (const VariableId v : contractor.reads()) slots_[v]->hand_over(access_[id].place_in(v));
  if (observer != nullptr) observer->before_contractor(*this, id);
  const double before = options_.clock();
  access_[id].settled_ = false;
  contractor.contract(access_[id]);
  if (access_[id].settled_) {
    agenda_.put_to_sleep(turn_[id]);
    for (const VariableId v : contractor.reads()) slots_[v]->drop(access_[id].place_in(v));
  }
  counts_[id].seconds += options_.clock() - before;
  ++counts_[id].calls;
  if (observer != nullptr) observer->after_contractor(*this, id);
}

// Ends a pass: no contractor that sweeps or searches runs twice in one. True when the threshold says that
// this was the last.
bool Propagation::end_pass(Observer* observer) {
  std::fill(ran_this_pass_.begin(), ran_this_pass_.end(), false);
  if (observer != nullptr) observer->after_pass(*this);
  if (options_.progress) options_.progress(pass_, elapsed());
  if (options_.threshold <= 0) return false;
  bool small = pass_ > 1;
  open_.resize(slots_.size(), 0.0);
  for (std::size_t v = 0; v < slots_.size(); ++v) {
    const double open = slots_[v] == nullptr ? 0.0 : slots_[v]->open();
    if (open < (1.0 - options_.threshold) * open_[v]) small = false;
    open_[v] = open;
  }
  return small;
}

Ending Propagation::run(Observer* observer) {
  for (const auto& contractor : graph_.contractors()) contractor->begin();
  failure_.reset();
  for (VariableId v = 0; v < slots_.size(); ++v) {
    if (slots_[v] == nullptr) continue;
    slots_[v]->wake_all(graph_.variable(v).readers().size());
    if (slots_[v]->is_empty() && !failure_) failure_ = Failure{std::nullopt, v, std::nullopt};
  }
  agenda_ = Agenda(graph_.contractors().size());
  ran_this_pass_.assign(graph_.contractors().size(), false);
  pass_ = 1;
  for (auto turn = agenda_.next(); turn && !failure_; turn = agenda_.next()) {
    if (out_of_limits()) return Ending::limit;
    const ContractorId next = schedule_[*turn];
    if (ran_this_pass_[next]) {
      if (end_pass(observer)) return Ending::limit;
      ++pass_;
    }
    run_contractor(next, observer);
  }
  static_cast<void>(end_pass(observer));
  if (failure_) return Ending::empty;
  return out_of_limits() ? Ending::limit : Ending::fixed_point;
}

}  // namespace hcsp
