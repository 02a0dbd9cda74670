// SPDX-License-Identifier: Apache-2.0
// What tests of the language share: models of the corpora, with their options in comments at the top.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "lang/lang.h"
#include "solver/engine/slot.h"

namespace hcsp::lang {

inline const std::filesystem::path kLangTests = std::filesystem::path(HCSP_SOURCE_DIR) / "tests" / "lang";

inline std::string read_text(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// The models of a folder, by name.
inline std::vector<std::filesystem::path> models_in(const std::filesystem::path& folder,
                                                    const std::vector<std::string>& endings = {".hcsp"}) {
  std::vector<std::filesystem::path> models;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    if (std::find(endings.begin(), endings.end(), file.path().extension()) != endings.end())
      models.push_back(file.path());
  }
  std::sort(models.begin(), models.end());
  return models;
}

/// A model's .expected file has this text.
inline void compare(const std::filesystem::path& model, const std::string& found) {
  std::filesystem::path expected = model;
  expected.replace_extension(".expected");
  if (std::getenv("HCSP_ACCEPT") != nullptr) {
    std::ofstream(expected, std::ios::binary) << found;
    return;
  }
  EXPECT_EQ(read_text(expected), found) << "after a look at it, tests/lang/accept.sh accepts the change";
}

inline std::string describe(const Interval& domain) { return to_string(domain); }
inline std::string describe(const Box& domain) { return to_string(domain); }
inline std::string describe(const SetInterval& domain) {
  return fmt::format("set, precision {}, volume at most {}", domain.precision(), domain.upper_volume());
}
inline std::string describe(const Tube& domain) {
  constexpr std::size_t kShownItems = 50;
  std::string text = fmt::format("tube of {} items", domain.items());
  for (std::size_t item = 0; item < std::min(domain.items(), kShownItems); ++item) {
    const Interval span = domain.line().span(item);
    text += item % 2 == 0 ? fmt::format("\n    at {}:", span.lo())
                          : fmt::format("\n    ({}, {}):", span.lo(), span.hi());
    for (std::size_t c = 0; c < domain.dim(); ++c) text += " " + to_string(domain.at(c, item));
  }
  return text;
}

template <class D>
bool describe(const Slot& slot, std::string& text) {
  const auto* typed = dynamic_cast<const TypedSlot<D>*>(&slot);
  if (typed != nullptr) text += describe(typed->domain) + "\n";
  return typed != nullptr;
}

/// The unknowns with what is known of them before solving, a line each.
inline std::string unknowns_of(const CompiledModel& model) {
  std::string text;
  for (const auto& variable : model.problem->graph().variables()) {
    if (variable.hidden()) continue;
    text += fmt::format("{}: ", variable.name());
    const Slot& slot = variable.initial();
    const bool known = describe<Interval>(slot, text) || describe<Box>(slot, text) ||
                       describe<Tube>(slot, text) || describe<SetInterval>(slot, text);
    if (!known) text += "?\n";
  }
  return text;
}

/// One mistake does not cascade. A model with several says how many.
inline std::size_t mistakes_in(const std::string& text) {
  const std::string mark = "// mistakes: ";
  const auto at = text.find(mark);
  return at == std::string::npos ? 1 : std::stoul(text.substr(at + mark.size()));
}

/// The options that lines `// --set NAME=VALUE` and `// --data NAME=FILE` at the top of a model ask for.
inline CompileOptions options_in(const std::string& model) {
  CompileOptions options;
  std::istringstream lines(model);
  for (std::string line; std::getline(lines, line) && line.starts_with("// --");) {
    const std::size_t space = line.find(' ', 3);
    const std::size_t equals = line.find('=');
    const std::string name = line.substr(space + 1, equals - space - 1);
    auto& map = line.starts_with("// --set") ? options.parameters : options.data_files;
    map[name] = line.substr(equals + 1);
  }
  return options;
}

/// Compiles a text as if it stood in tests/lang/<folder>/<name>; messages then call it <folder>/<name>.
inline Compilation compile_as(const std::string& name, const std::string& text,
                              const CompileOptions& options = {}) {
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(kLangTests);
  Compilation compilation = compile_text({name, text}, options);
  std::filesystem::current_path(before);
  return compilation;
}

/// A whole model around some items.
inline std::string whole_model(const std::string& items) {
  if (items.find("model m;") != std::string::npos) return items + "\n";
  const bool solves = items.find("solve ") != std::string::npos;
  return "model m;\n" + items + (solves ? "\n" : "\nsolve propagate;\n");
}

}  // namespace hcsp::lang
