// SPDX-License-Identifier: Apache-2.0
// When what is given is evaluated: what most cases need, at the start of a solve; the rest when a case needs
// it. Conditions that all cases have are tested once; those that are only implied tell why there is no
// solution, and are left until none was found.
#pragma once

#include <vector>

#include "solver/online/code.h"

namespace hcsp::online {

/// A case as code, and where its solutions are read.
struct CompiledCase;

struct Givens {
  std::vector<Instruction> always;
  std::vector<Test> required;  ///< of all searches, stated; of what is always evaluated
  std::vector<Instruction> late;
  std::vector<Test> reasons;  ///< of all searches, implied; after `late`
  std::vector<Instruction> proof;
  std::vector<Test> certain;  ///< of all proofs; after `proof`
};

/// Takes the conditions that they share out of the cases, and gives each its prelude.
Givens share_givens(const Prefix& prefix, std::vector<CompiledCase>& cases);

}  // namespace hcsp::online
