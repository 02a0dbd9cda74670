// SPDX-License-Identifier: Apache-2.0
#include "solver/search/hc4.h"

#include <cmath>

#include "domains/interval/kernel.h"

namespace hcsp {

namespace {

// What a domain has to lose of its width for its relations to be looked at again.
constexpr double kWorthTelling = 0.01;
// Where domains creep, search is faster.
constexpr std::size_t kMostRounds = 100;

bool is_worth_telling(const Interval& before, const Interval& now) {
  if (before.is_bounded()) return now.hi() - now.lo() < (1.0 - kWorthTelling) * (before.hi() - before.lo());
  return !(before == now);
}

}  // namespace

Hc4::Hc4(const System& system)
    : system_(system),
      run_(*system.tape),
      told_(system.size()),
      queue_(system.relations.size() + 1),
      awake_(system.relations.size()) {}

void Hc4::wake(std::uint32_t relation) {
  if (awake_[relation] != 0) return;
  awake_[relation] = 1;
  queue_[(first_ + count_++) % queue_.size()] = relation;
}

bool Hc4::contract(std::vector<Interval>& box) {
  for (std::uint32_t i = 0; i < system_.relations.size(); ++i) wake(i);
  return run(box);
}

bool Hc4::contract(std::vector<Interval>& box, std::uint32_t changed) {
  for (const std::uint32_t i : system_.relations_of[changed]) wake(i);
  return run(box);
}

bool Hc4::run(std::vector<Interval>& box) {
  run_.start(box);
  std::copy(box.begin(), box.end(), told_.begin());
  bool alive = true;
  std::size_t left = kMostRounds * system_.relations.size();
  while (count_ > 0) {
    const std::uint32_t relation = queue_[first_];
    first_ = (first_ + 1) % queue_.size();
    --count_;
    awake_[relation] = 0;
    if (!alive || left == 0) continue;
    --left;
    alive = run_.revise(relation, system_.relations[relation].wanted);
    if (!alive) continue;
    for (const std::uint32_t v : system_.tape->variables(relation)) {
      if (!is_worth_telling(told_[v], run_.variable(v))) continue;
      told_[v] = run_.variable(v);
      for (const std::uint32_t other : system_.relations_of[v]) {
        if (other != relation) wake(other);
      }
    }
  }
  if (!alive) return false;
  for (std::size_t v = 0; v < box.size(); ++v) box[v] = run_.variable(v);
  return true;
}

}  // namespace hcsp
