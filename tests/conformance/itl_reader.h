// SPDX-License-Identifier: Apache-2.0
// The interval test language of ITF1788: a file is a list of test cases, `testcase NAME { ... }`, of
// statements `operation operands = results signal EXCEPTION;`.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "domains/interval/decorated.h"

namespace hcsp::itl {

/// An interval literal. Its bounds are the doubles nearest to the decimals, as the suite means them.
struct Literal {
  DecoratedInterval value;
  /// Whether the decoration was written, or follows from the operation; else it does not count.
  bool is_decorated;
};

struct Text {
  std::string characters;
};
/// true, com, containedBy, ...
struct Word {
  std::string name;
};

using Value = std::variant<Literal, double, Word, Text, std::vector<double>>;

struct Statement {
  int line;
  std::string text;
  std::string operation;
  std::vector<Value> operands, results;
  /// The exception that is to be signalled, or nothing.
  std::string signal;
};

/// Where a file is not in the language: file:line:column, what was expected, the line and a caret.
class Malformed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws Malformed, or std::runtime_error where the file cannot be read.
std::vector<Statement> read(const std::string& file);

}  // namespace hcsp::itl
