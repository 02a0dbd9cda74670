// SPDX-License-Identifier: Apache-2.0
// When what is given is evaluated: what most cases need, at the start of a solve; the rest when a case needs
// it. Conditions are tested once for all cases that have them; those that are only implied tell why there is
// no solution, and are left until none was found.
#pragma once

#include <vector>

#include "solver/online/case_set.h"
#include "solver/online/sections.h"

namespace hcsp::online {

/// A case as code, and where its solutions are read.
struct CompiledCase;

/// A condition, or a divisor, and the cases that have it.
struct Filter {
  Test test;
  CaseSet cases;
};
struct Divisor {
  Register reg;
  CaseSet cases;
};

struct Givens {
  std::vector<Section> always;
  std::vector<Test> required;   ///< of all searches, stated; of what is always evaluated
  std::vector<Filter> filters;  ///< of searches, after `always`; first those that most have
  std::vector<Divisor> divisors;
  std::vector<Instruction> late;
  std::vector<Test> reasons;  ///< of all searches, implied; after `late`
  std::vector<Instruction> proof;
  std::vector<Test> certain;  ///< of all proofs; after `proof`
};

/// Takes the conditions out of the cases that need no prelude, and gives each its prelude.
Givens share_givens(const Prefix& prefix, std::vector<CompiledCase>& cases);

}  // namespace hcsp::online
