// SPDX-License-Identifier: Apache-2.0
#include "lang/minibex/minibex.h"

#include <algorithm>
#include <filesystem>

#include "lang/minibex/compiler.h"
#include "lang/minibex/parser.h"

namespace hcsp::lang::minibex {

namespace {

// IBEX's defaults; of a minimum, the relative and the absolute gap.
constexpr double kPrecision = 1e-3, kAbsolutePrecision = 1e-7;

void replace_constants(const CompileOptions& options, Program& program, Compilation& compilation) {
  for (const auto& [name, value] : options.parameters) {
    const Source& source = compilation.tree->add_source(fmt::format("--set {}", name), value);
    const auto replaced =
        std::find_if(program.constants.begin(), program.constants.end(),
                     [&sought = name](const Declaration& known) { return known.name.text == sought; });
    if (replaced == program.constants.end()) {
      std::vector<std::string> names;
      for (const Declaration& constant : program.constants) names.emplace_back(constant.name.text);
      const SourceRange range{&source, 0, static_cast<std::uint32_t>(value.size())};
      compilation.diagnostics.report(Code::unknown_parameter, range, name).did_you_mean(name, names);
      continue;
    }
    const Expr* expr = parse_expression(source, program, compilation.diagnostics);
    if (expr != nullptr) replaced->value = expr;
  }
}

void require_items(const Source& source, const CompileOptions& options, const Program& program,
                   Compilation& compilation) {
  const auto end = static_cast<std::uint32_t>(source.text().size());
  if (program.variables.empty())
    compilation.diagnostics.report(Code::item_missing, {&source, end, end}, "Variables")
        .note("say `Variables x in [0, 1];`");
  for (const auto& [name, path] : options.data_files) {
    const Source& written = compilation.tree->add_source(fmt::format("--data {}", name), path);
    compilation.diagnostics.report(Code::unknown_data, {&written, 0, static_cast<std::uint32_t>(path.size())},
                                   name);
  }
}

}  // namespace

bool is_minibex(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char& c : ending) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return ending == ".bch" || ending == ".mbx" || ending == ".txt";
}

void compile(const Source& source, const CompileOptions& options, Compilation& compilation) {
  Program program = parse(source, compilation.diagnostics);
  // What was not read cannot be missed.
  if (compilation.diagnostics.any()) return;
  require_items(source, options, program, compilation);
  replace_constants(options, program, compilation);
  if (compilation.diagnostics.any()) return;
  CompiledModel model;
  model.name = std::filesystem::path(source.name()).stem().string();
  Compiler compiler(program, model.name, compilation.diagnostics);
  model.problem = compiler.run();
  compilation.types = compiler.types();
  if (model.problem == nullptr) return;
  model.objective = compiler.objective();
  model.goal = model.objective ? SolveItem::Goal::minimize : SolveItem::Goal::all;
  model.precision = kPrecision;
  model.absolute_precision = kAbsolutePrecision;
  compilation.model = std::move(model);
}

}  // namespace hcsp::lang::minibex
