// SPDX-License-Identifier: Apache-2.0
// Diagnostics: what is wrong with a person's model or data, and where. Each has a code of the catalogue
// (catalogue.h), a range of a source, a message, and notes that teach.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

#include "lang/catalogue.h"
#include "lang/source.h"

namespace hcsp::lang {

struct Diagnostic {
  Code code;
  SourceRange range;
  std::string message;
  std::vector<std::string> notes;

  Diagnostic& note(std::string text) {
    notes.push_back(std::move(text));
    return *this;
  }
  /// Adds "did you mean `x`?" when one of the candidates is near to the name.
  Diagnostic& did_you_mean(std::string_view name, const std::vector<std::string>& candidates);
};

/// file:line:column: error[E012]: message, the source line with a caret under the range, the notes.
std::string render(const Diagnostic& diagnostic);

class Diagnostics {
 public:
  /// Reports with the catalogue's format of the code. The reference is valid until the next report.
  template <class... Args>
  Diagnostic& report(Code code, const SourceRange& range, const Args&... args) {
    return add({code, range, fmt::vformat(entry(code).format, fmt::make_format_args(args...)), {}});
  }

  /// Adds a diagnostic that was made elsewhere.
  Diagnostic& add(Diagnostic diagnostic) { return all_.emplace_back(std::move(diagnostic)); }

  [[nodiscard]] bool any() const { return !all_.empty(); }
  [[nodiscard]] std::size_t count() const { return all_.size(); }
  [[nodiscard]] const std::vector<Diagnostic>& all() const { return all_; }
  /// In the order of their places, source by source in the order of first report; at most kMostShown, and a
  /// last line that counts the others.
  [[nodiscard]] std::string text() const;
  static constexpr std::size_t kMostShown = 50;

 private:
  std::vector<Diagnostic> all_;
};

}  // namespace hcsp::lang
