// SPDX-License-Identifier: Apache-2.0
// From a model file to a Problem: the one entry of the language. Nothing here prints, exits or throws for
// what a person wrote: mistakes are diagnostics.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lang/diagnostics.h"
#include "lang/syntax/ast.h"
#include "solver/problem.h"

namespace hcsp::lang {

/// The folders of the environment's HCSP_LIBRARY, a list with colons, then that of the models that come with
/// hcsp: `include "library/polar.hcsp"` is found there.
std::vector<std::string> library_folders();

/// The text of a model, in the language that the ending of `name` says: Minibex for .bch, .mbx and .txt, else
/// that of hcsp. Paths in it are relative to the folder of `name`.
struct ModelSource {
  std::string name;
  std::string text;
};

struct CompileOptions {
  /// `--set NAME=VALUE`: values of parameters, as constant expressions or domains of the language.
  std::map<std::string, std::string> parameters;
  /// `--data NAME=FILE`: files that replace those of the model, relative to the working folder.
  std::map<std::string, std::string> data_files;
  /// Parameters that are reals or vectors, and that the structure of the model does not depend on, stay open:
  /// Problem::parameter(). The values of the model, or of `parameters`, are what they are until they are set.
  bool open_parameters = false;
  /// Where `include` looks for a file that is not beside the one that names it.
  std::vector<std::string> library = library_folders();
  Clock clock = steady_clock();
};

struct CompiledModel {
  std::string name;
  std::unique_ptr<Problem> problem;
  SolveItem::Goal goal = SolveItem::Goal::propagate;
  double precision = SearchOptions{}.precision;  ///< of the goals that have one
  double absolute_precision = 0.0;               ///< SearchOptions::absolute_precision
  std::optional<hcsp::Expr> objective;           ///< of the goals minimize and maximize
  std::vector<hcsp::Expr> paved;                 ///< the coordinates of `solve pave`
  std::vector<std::string> shown;                ///< what the model asks to show, in its order
  /// From the first use of a data value to the finished Problem: part of what a result calls its seconds.
  double data_seconds = 0.0;
};

/// What became of a model: its syntax tree as far as it was read, and the Problem or what is wrong.
struct Compilation {
  std::unique_ptr<SyntaxTree> tree;
  std::string
      types;  ///< a line a name of the model, in its order: `x : tube real[2]`; empty when it cannot be read
  Diagnostics diagnostics;
  std::optional<CompiledModel> model;  ///< exactly when there are no diagnostics
};

Compilation compile_file(const std::string& path, const CompileOptions& options = {});
Compilation compile_text(ModelSource source, const CompileOptions& options = {});

}  // namespace hcsp::lang
