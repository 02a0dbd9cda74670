// SPDX-License-Identifier: Apache-2.0
// From a model file to a problem that is compiled once and solved in a control loop.
#pragma once

#include <string>

#include "lang/lang.h"
#include "solver/online/compiled_problem.h"

namespace hcsp {

/// Compiles a model of numbers, with a time line of phases or none, for `solve minimize`, `solve maximize` or
/// a solution. Its parameters are open but for those that its structure depends on, such as a number of
/// joints: those are `model.parameters`. The precision is the model's, whatever `online` says.
/// std::invalid_argument with the diagnostics where the model is wrong, or one that cannot be compiled so.
CompiledProblem compile(const std::string& model_file, lang::CompileOptions model = {},
                        OnlineOptions online = {});

}  // namespace hcsp
