// SPDX-License-Identifier: Apache-2.0
// What tests of the language share: models of the corpora, with their options in comments at the top.
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "lang/lang.h"

namespace hcsp::lang {

inline const std::filesystem::path kLangTests = std::filesystem::path(HCSP_SOURCE_DIR) / "tests" / "lang";

inline std::string read_text(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// The models of a folder, by name.
inline std::vector<std::filesystem::path> models_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> models;
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    if (file.path().extension() == ".hcsp") models.push_back(file.path());
  }
  std::sort(models.begin(), models.end());
  return models;
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
