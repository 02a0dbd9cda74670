// SPDX-License-Identifier: Apache-2.0
// What parameters alone refute: all cases at once, or one.
#include <algorithm>

#include "solver/online/search.h"

namespace hcsp::online {

// Whether a relation that all cases have, though only implied, tells that there is no solution, and which.
bool Search::is_out_of_reason() {
  machine_.evaluate(givens_.late);
  if (!is_refuted(givens_.reasons)) return false;
  finding_.lower = kInfinity;
  finding_.is_exhausted = false;
  return true;
}

// Whether a test that all cases have holds nowhere: the first, or one that is decisive.
bool Search::is_refuted(std::span<const Test> tests) {
  bool is_one = false;
  for (const Test& test : tests) {
    if (finding_.is_decided) break;
    const bool is_better = !is_one || is_decisive_[test.name];
    if (!is_better || machine_.is_possible(test)) continue;
    finding_.refuted_by = test.name;
    finding_.is_decided = is_decisive_[test.name];
    is_one = true;
  }
  return is_one;
}

// Looks once at what several cases have. Where a divisor may be 0 what its quotients say does not count.
void Search::sift() {
  left_.fill(cases_.size());
  irregular_.fill(0);
  for (const Divisor& divisor : givens_.divisors) {
    if (machine_.value(divisor.reg).contains(0.0)) irregular_.insert(divisor.cases);
  }
  for (const Filter& filter : givens_.filters) {
    if (!left_.meets(filter.cases) || machine_.is_possible(filter.test)) continue;
    const CaseSet& safe = filter.test.is_of_quotient ? irregular_ : none_;
    refutations_[filter.test.name] += left_.remove(filter.cases, safe);
  }
}

// Evaluates what a case alone needs, unless a condition of that holds nowhere.
bool Search::is_refuted_by_prelude(std::size_t number) {
  const bool is_regular = !irregular_.contains(number);
  for (const Code::Part& part : cases_[number].search.prelude) {
    machine_.evaluate(part.code);
    for (const Test& test : part.conditions) {
      if ((test.is_of_quotient && !is_regular) || machine_.is_possible(test)) continue;
      ++refutations_[test.name];
      return true;
    }
  }
  return false;
}

}  // namespace hcsp::online
