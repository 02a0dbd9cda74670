// SPDX-License-Identifier: Apache-2.0
#include "lang/online.h"

#include <stdexcept>

namespace hcsp {

CompiledProblem compile(const std::string& model_file, lang::CompileOptions model, OnlineOptions online) {
  model.open_parameters = true;
  const lang::Compilation compilation = lang::compile_file(model_file, model);
  if (!compilation.model) throw std::invalid_argument(compilation.diagnostics.text());
  const lang::CompiledModel& compiled = *compilation.model;
  online.precision = compiled.precision;
  const bool is_maximum = compiled.goal == lang::SolveItem::Goal::maximize;
  const std::optional<Expr> objective =
      compiled.objective && is_maximum ? std::optional<Expr>(-*compiled.objective) : compiled.objective;
  return compile(*compiled.problem, objective, online);
}

}  // namespace hcsp
