// SPDX-License-Identifier: Apache-2.0
#include "tests/verifier/interpreter.h"
#include "tests/verifier/reader.h"

namespace hcsp::verifier {

namespace {

/// One item after the other; what has no order in the language has it in the models that are read.
class HcspReader {
 public:
  explicit HcspReader(const std::string& text) : reader_(text), interpreter_(system_) {}

  System read() {
    while (!reader_.at_end()) item();
    return std::move(system_);
  }

 private:
  void item() {
    const int line = reader_.token().line;
    if (reader_.take("param") || reader_.take("let")) {
      named();
    } else if (reader_.take("var")) {
      variables();
    } else if (reader_.take("function")) {
      function();
    } else if (reader_.take("constraint")) {
      if (reader_.token(1).text == ":") {
        reader_.name();
        reader_.expect(":");
      }
      interpreter_.constrain(reader_.expression());
    } else if (reader_.sees("model") || reader_.sees("solve") || reader_.sees("show")) {
      while (!reader_.sees(";") && !reader_.at_end()) reader_.take(reader_.token().text);
    } else {
      throw Unreadable(line, "an item that is not understood: " + reader_.token().text);
    }
    reader_.expect(";");
  }

  void named() {
    const std::string name = reader_.name();
    if (reader_.take(":")) type();
    reader_.expect("=");
    interpreter_.name(name, interpreter_.value(reader_.expression()));
  }

  void variables() {
    std::vector<std::string> names;
    do names.push_back(reader_.name());
    while (reader_.take(","));
    reader_.expect(":");
    const auto ranges = type();
    reader_.expect("in");
    const Tree domain = reader_.expression();
    for (const std::string& name : names) interpreter_.declare(name, ranges, domain);
  }

  /// The ranges of indices of `array[a..b] of real[n]`.
  std::vector<std::pair<long, long>> type() {
    std::vector<std::pair<long, long>> ranges;
    while (reader_.take("array")) {
      sizes(ranges);
      reader_.expect("of");
    }
    reader_.name();
    if (reader_.sees("[")) sizes(ranges);
    return ranges;
  }

  void sizes(std::vector<std::pair<long, long>>& ranges) {
    reader_.expect("[");
    for (const Tree& size : reader_.list("]")) {
      if (size.head == "..") {
        ranges.emplace_back(interpreter_.whole(size.parts[0]), interpreter_.whole(size.parts[1]));
      } else {
        ranges.emplace_back(1, interpreter_.whole(size));
      }
    }
  }

  void function() {
    const std::string name = reader_.name();
    Function function{{}, {}, {}};
    reader_.expect("(");
    do {
      function.parameters.push_back(reader_.name());
      reader_.expect(":");
      type();
    } while (reader_.take(","));
    reader_.expect(")");
    reader_.expect(":");
    type();
    reader_.expect("=");
    function.value = reader_.expression();
    if (reader_.take("where")) {
      do {
        const std::string local = reader_.name();
        reader_.expect("=");
        function.locals.emplace_back(local, reader_.expression());
      } while (reader_.take(","));
    }
    interpreter_.define(name, std::move(function));
  }

  System system_;
  Reader reader_;
  Interpreter interpreter_;
};

}  // namespace

System read_hcsp(const std::string& text) { return HcspReader(text).read(); }

}  // namespace hcsp::verifier
