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

// Where divisors may be 0 what their quotients say does not count.
bool Search::is_refuted_by_givens(std::size_t number, bool& is_regular) {
  const auto refutes = [&](const Test& test) {
    if (machine_.is_possible(test) || (test.is_of_quotient && !is_regular)) return false;
    ++refutations_[test.name];
    return true;
  };
  const Code& code = cases_[number].search;
  const Test& likely = likely_[number];
  const bool has_likely = code.quick > 0;
  if (has_likely && !likely.is_of_quotient && refutes(likely)) return true;
  is_regular = std::none_of(code.nonzero.begin(), code.nonzero.end(),
                            [&](Register factor) { return machine_.value(factor).contains(0.0); });
  if (has_likely && likely.is_of_quotient && refutes(likely)) return true;
  const std::span<const Test> conditions = code.conditions;
  for (const Test& test : conditions.first(code.quick)) {
    if (!refutes(test)) continue;
    likely_[number] = test;
    return true;
  }
  machine_.evaluate(code.prelude);
  const auto late = conditions.subspan(code.quick);
  return std::any_of(late.begin(), late.end(), refutes);
}

}  // namespace hcsp::online
