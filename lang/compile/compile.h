// SPDX-License-Identifier: Apache-2.0
// From a checked model to a Problem.
#pragma once

#include <memory>

#include "lang/model/model.h"
#include "solver/problem.h"

namespace hcsp::lang {

/// Null after a report.
std::unique_ptr<Problem> compile(Model& model);

}  // namespace hcsp::lang
