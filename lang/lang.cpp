// SPDX-License-Identifier: Apache-2.0
#include "lang/lang.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "domains/rounding.h"
#include "lang/check/check.h"
#include "lang/check/structure.h"
#include "lang/compile/compile.h"
#include "lang/data/file.h"
#include "lang/loader.h"
#include "lang/minibex/minibex.h"
#include "lang/syntax/parser.h"

namespace hcsp::lang {

namespace {

void require_items(const SyntaxTree& tree, const Source& source, Diagnostics& diagnostics) {
  const auto has = [&](auto holds) { return std::any_of(tree.items.begin(), tree.items.end(), holds); };
  const auto end = static_cast<std::uint32_t>(source.text().size());
  if (!has([](const Item& item) { return std::holds_alternative<ModelItem>(item.content); })) {
    diagnostics.report(Code::item_missing, {&source, 0, 0}, "model").note("start with `model name;`");
  }
  if (!has([](const Item& item) { return std::holds_alternative<SolveItem>(item.content); })) {
    diagnostics.report(Code::item_missing, {&source, end, end}, "solve").note("say `solve propagate;`");
  }
}

void replace_parameters(Compilation& compilation, const std::map<std::string, std::string>& values) {
  for (const auto& [name, value] : values) {
    ParamItem* replaced = nullptr;
    std::vector<std::string> names;
    for (Item& item : compilation.tree->items) {
      auto* param = std::get_if<ParamItem>(&item.content);
      if (param == nullptr) continue;
      names.emplace_back(param->name.text);
      if (param->name.text == name && replaced == nullptr) replaced = param;
    }
    const Source& source = compilation.tree->add_source(fmt::format("--set {}", name), value);
    if (replaced == nullptr) {
      const SourceRange range{&source, 0, static_cast<std::uint32_t>(value.size())};
      compilation.diagnostics.report(Code::unknown_parameter, range, name).did_you_mean(name, names);
      continue;
    }
    Expr* expr = parse_expression(source, *compilation.tree, compilation.diagnostics);
    if (expr != nullptr) replaced->value = expr;
  }
}

void check_data_names(Compilation& compilation, const std::map<std::string, std::string>& files) {
  std::vector<std::string> names;
  for (const Item& item : compilation.tree->items) {
    if (const auto* data = std::get_if<DataItem>(&item.content)) names.emplace_back(data->name.text);
  }
  for (const auto& [name, path] : files) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    const Source& source = compilation.tree->add_source(fmt::format("--data {}", name), path);
    const SourceRange range{&source, 0, static_cast<std::uint32_t>(path.size())};
    compilation.diagnostics.report(Code::unknown_data, range, name).did_you_mean(name, names);
  }
}

void build(Compilation& compilation, const CompileOptions& options) {
  Model model(*compilation.tree, compilation.diagnostics);
  if (options.open_parameters) model.open_parameters = parameters_without_structure(*compilation.tree);
  check(model, options.data_files);
  compilation.types = dump_types(model);
  if (compilation.diagnostics.any()) return;
  const double start = options.clock();
  CompiledModel compiled;
  compiled.problem = compile(model);
  compiled.data_seconds = options.clock() - start;
  if (compilation.diagnostics.any() || compiled.problem == nullptr) return;
  compiled.name = model.name;
  compiled.goal = model.goal->goal;
  if (model.precision > 0) compiled.precision = model.precision;
  compiled.objective = model.objective;
  compiled.paved = model.paved;
  for (const Item& item : compilation.tree->items) {
    const auto* show = std::get_if<ShowItem>(&item.content);
    if (show == nullptr) continue;
    for (const Expr* expr : show->shown) compiled.shown.emplace_back(expr->text);
  }
  compilation.model = std::move(compiled);
}

}  // namespace

std::vector<std::string> library_folders() {
  std::vector<std::string> folders;
  const char* listed = std::getenv("HCSP_LIBRARY");
  std::istringstream list(listed == nullptr ? "" : listed);
  for (std::string folder; std::getline(list, folder, ':');) {
    if (!folder.empty()) folders.push_back(folder);
  }
  folders.insert(folders.end(), {HCSP_INSTALLED_MODELS, HCSP_SOURCE_MODELS});
  return folders;
}

Compilation compile_file(const std::string& path, const CompileOptions& options) {
  std::string error;
  auto text = read_file(path, error);
  if (text) return compile_text({path, std::move(*text)}, options);
  Compilation compilation;
  compilation.tree = std::make_unique<SyntaxTree>();
  compilation.diagnostics.report(Code::unreadable_file, {}, path, error);
  return compilation;
}

Compilation compile_text(ModelSource text, const CompileOptions& options) {
  RoundNearest rounding;  // whatever the embedding program left set
  Compilation compilation;
  compilation.tree = std::make_unique<SyntaxTree>();
  const Source& source = compilation.tree->add_source(std::move(text.name), std::move(text.text));
  if (minibex::is_minibex(source.name())) {
    minibex::compile(source, options, compilation);
    return compilation;
  }
  load(source, *compilation.tree, options.library, compilation.diagnostics);
  // What was not read cannot be missed: without all the items, names would be unknown for no fault of theirs.
  if (compilation.diagnostics.any()) return compilation;
  require_items(*compilation.tree, source, compilation.diagnostics);
  replace_parameters(compilation, options.parameters);
  check_data_names(compilation, options.data_files);
  if (compilation.diagnostics.any()) return compilation;
  build(compilation, options);
  return compilation;
}

}  // namespace hcsp::lang
